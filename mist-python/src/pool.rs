//! The threads that compute: one pool for each computation that runs at the same time.

use std::{
    num::NonZeroUsize,
    sync::{Arc, Mutex, PoisonError},
};

use pyo3::{exceptions::PyRuntimeError, prelude::*};
use rayon::{ThreadPool, ThreadPoolBuilder};

/// Pools without work, and the number of threads of new ones.
struct IdlePools {
    threads: Option<NonZeroUsize>,
    pools: Vec<Arc<ThreadPool>>,
}

static IDLE: Mutex<IdlePools> = Mutex::new(IdlePools { threads: None, pools: Vec::new() });

impl IdlePools {
    fn with<T>(access: impl FnOnce(&mut Self) -> T) -> T {
        access(&mut IDLE.lock().unwrap_or_else(PoisonError::into_inner))
    }

    fn threads(&self) -> usize {
        let given = std::env::var("MIST_THREADS").ok().and_then(|text| text.parse().ok());
        self.threads
            .or(given)
            .or_else(|| std::thread::available_parallelism().ok())
            .map_or(1, NonZeroUsize::get)
    }
}

/// A pool that serves one computation, and is idle again when it is dropped.
pub(crate) struct BorrowedPool(Arc<ThreadPool>);

impl BorrowedPool {
    /// An idle pool, or a new one of `threads` threads.
    pub(crate) fn take(threads: Option<usize>) -> PyResult<Self> {
        let (wanted, idle) = IdlePools::with(|idle| {
            let wanted = threads.unwrap_or_else(|| idle.threads()).max(1);
            let at = idle.pools.iter().position(|pool| pool.current_num_threads() == wanted);
            (wanted, at.map(|at| idle.pools.swap_remove(at)))
        });
        if let Some(pool) = idle {
            return Ok(Self(pool));
        }
        let name = |number| format!("mist-{number}");
        let pool = ThreadPoolBuilder::new().num_threads(wanted).thread_name(name).build();
        let pool = pool.map_err(|error| {
            PyRuntimeError::new_err(format!("cannot start {wanted} threads: {error}"))
        })?;
        Ok(Self(Arc::new(pool)))
    }

    pub(crate) fn threads(&self) -> &ThreadPool {
        &self.0
    }
}

impl Drop for BorrowedPool {
    fn drop(&mut self) {
        IdlePools::with(|idle| idle.pools.push(self.0.clone()));
    }
}

/// Number of threads of a computation.
#[pyfunction]
pub(crate) fn threads() -> usize {
    IdlePools::with(|idle| idle.threads())
}

/// Sets the number of threads of a computation; none for the number of processors.
#[pyfunction]
#[pyo3(signature = (count=None))]
pub(crate) fn set_threads(count: Option<NonZeroUsize>) {
    let old = IdlePools::with(|idle| {
        idle.threads = count;
        std::mem::take(&mut idle.pools)
    });
    drop(old);
}

/// Forgets the threads in a process that was forked, which has none of them.
#[pyfunction]
pub(crate) fn forget_threads() {
    let old = IdlePools::with(|idle| std::mem::take(&mut idle.pools));
    // To drop a pool is to wait for its threads, which do not exist here.
    old.into_iter().for_each(std::mem::forget);
}
