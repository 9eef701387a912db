//! Computations on a pool while the caller looks for signals.

use std::{
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    sync::{
        Arc, Condvar, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};

use pyo3::prelude::*;
use scattering::interrupt;

use crate::pool::BorrowedPool;

/// Time between two looks for signals.
const LOOK: Duration = Duration::from_millis(20);

/// The result of a computation on another thread, when there is one.
struct Outcome<T> {
    result: Mutex<Option<std::thread::Result<T>>>,
    is_there: Condvar,
}

impl<T> Outcome<T> {
    fn lock(&self) -> MutexGuard<'_, Option<std::thread::Result<T>>> {
        self.result.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The result if it comes within [`LOOK`].
    fn wait(&self) -> Option<std::thread::Result<T>> {
        let waited = self.is_there.wait_timeout_while(self.lock(), LOOK, |result| result.is_none());
        waited.unwrap_or_else(PoisonError::into_inner).0.take()
    }
}

/// Runs `work` on a pool of threads, without Python's lock; it gets the flag that ends it.
///
/// Signals, and what `look` does every 20 ms, may raise an exception: it sets the flag.
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    threads: Option<usize>,
    work: impl FnOnce(&Arc<AtomicBool>) -> T + Send,
    mut look: impl FnMut(Python<'_>) -> PyResult<()>,
) -> PyResult<T> {
    let pool = BorrowedPool::take(threads)?;
    let flag = Arc::new(AtomicBool::new(false));
    let outcome = Outcome { result: Mutex::new(None), is_there: Condvar::new() };
    pool.threads().in_place_scope(|scope| {
        scope.spawn(|_| {
            rayon::broadcast(|_| interrupt::follow(Some(flag.clone())));
            let result = catch_unwind(AssertUnwindSafe(|| work(&flag)));
            rayon::broadcast(|_| interrupt::follow(None));
            *outcome.lock() = Some(result);
            outcome.is_there.notify_one();
        });
        let mut raised = None;
        let result = loop {
            if let Some(result) = py.detach(|| outcome.wait()) {
                break result;
            }
            if raised.is_none()
                && let Err(error) = py.check_signals().and_then(|()| look(py))
            {
                flag.store(true, Ordering::Relaxed);
                raised = Some(error);
            }
        };
        match (raised, result) {
            (Some(error), _) => Err(error),
            (None, Ok(value)) => Ok(value),
            (None, Err(panic)) => resume_unwind(panic),
        }
    })
}
