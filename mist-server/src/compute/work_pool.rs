//! Threads of one computation, which end it when its flag is set.

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{Arc, atomic::AtomicBool},
};

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use scattering::interrupt;

/// Threads that work for one computation at a time, so that the operating system divides the
/// processors fairly between computations.
#[derive(Debug)]
pub(crate) struct WorkPool(ThreadPool);

/// The reason why a computation has no result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WorkFailure {
    /// Its flag was set.
    Interrupted,
    /// It panicked.
    Panicked,
}

impl WorkPool {
    /// As many threads as rayon's own pool has.
    ///
    /// # Errors
    ///
    /// If the system has no more threads.
    pub(crate) fn new() -> Result<Self, ThreadPoolBuildError> {
        let threads = rayon::current_num_threads();
        let name = |number| format!("mist-work-{number}");
        ThreadPoolBuilder::new().num_threads(threads).thread_name(name).build().map(Self)
    }

    /// Runs `work` on these threads and waits for it.
    pub(crate) fn run<T: Send>(
        &self,
        flag: &Arc<AtomicBool>,
        work: impl FnOnce() -> T + Send,
    ) -> Result<T, WorkFailure> {
        self.0.install(|| run_here(flag, work))
    }

    /// Runs `work` on these threads, then calls `done` there.
    pub(super) fn start<T: Send + 'static>(
        self: &Arc<Self>,
        flag: Arc<AtomicBool>,
        work: impl FnOnce() -> T + Send + 'static,
        done: impl FnOnce(Result<T, WorkFailure>) + Send + 'static,
    ) {
        self.0.spawn(move || done(run_here(&flag, work)));
    }
}

/// Runs `work` on a thread of a pool, all of whose threads follow `flag` meanwhile.
fn run_here<T>(flag: &Arc<AtomicBool>, work: impl FnOnce() -> T) -> Result<T, WorkFailure> {
    rayon::broadcast(|_| interrupt::follow(Some(flag.clone())));
    let ended = catch_unwind(AssertUnwindSafe(|| interrupt::until(flag, work)));
    rayon::broadcast(|_| interrupt::follow(None));
    match ended {
        Ok(Ok(done)) => Ok(done),
        Ok(Err(interrupt::Interrupted)) => Err(WorkFailure::Interrupted),
        Err(_) => Err(WorkFailure::Panicked),
    }
}
