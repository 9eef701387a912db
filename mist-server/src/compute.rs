//! Computations on rayon's threads, away from the threads that answer requests.

use std::sync::{
    Arc,
    atomic::{AtomicUsize, Ordering},
};

use tokio::sync::{OwnedSemaphorePermit, Semaphore, oneshot};

/// Runs closures on rayon's threads, a bounded number at a time.
#[derive(Clone, Debug)]
pub(crate) struct ComputePool {
    slots: Arc<Semaphore>,
    waiting: Arc<AtomicUsize>,
    max_waiting: usize,
}

/// The reason why a computation has no result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum ComputeError {
    /// It panicked.
    #[error("the computation broke down")]
    Panicked,
    /// It was not begun: so many wait already.
    #[error("{0} computations wait already")]
    QueueFull(usize),
}

/// Counts a computation while it waits.
struct WaitingCount(Arc<AtomicUsize>);

impl Drop for WaitingCount {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

impl ComputePool {
    /// At most `slots` computations at a time, each using all threads, while at most
    /// `max_waiting` wait.
    pub(crate) fn new(slots: usize, max_waiting: usize) -> Self {
        let slots = Arc::new(Semaphore::new(slots.max(1)));
        Self { slots, waiting: Arc::default(), max_waiting }
    }

    /// Number of computations that wait.
    pub(crate) fn waiting(&self) -> usize {
        self.waiting.load(Ordering::Relaxed)
    }

    /// Runs `work` when a slot is free.
    pub(crate) async fn run<T: Send + 'static>(
        &self,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T, ComputeError> {
        let slot = match self.slots.clone().try_acquire_owned() {
            Ok(slot) => slot,
            Err(_) => self.wait().await?,
        };
        let (answer, answered) = oneshot::channel();
        rayon::spawn(move || {
            let _slot = slot;
            let done = std::panic::catch_unwind(std::panic::AssertUnwindSafe(work));
            // On a panic the sender is dropped; a receiver that is gone needs no answer.
            if let Ok(done) = done {
                let _ = answer.send(done);
            }
        });
        answered.await.map_err(|_| ComputeError::Panicked)
    }

    async fn wait(&self) -> Result<OwnedSemaphorePermit, ComputeError> {
        let before = self.waiting.fetch_add(1, Ordering::Relaxed);
        let _waiting = WaitingCount(self.waiting.clone());
        if before >= self.max_waiting {
            return Err(ComputeError::QueueFull(self.max_waiting));
        }
        // The semaphore is never closed.
        self.slots.clone().acquire_owned().await.map_err(|_| ComputeError::Panicked)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn work_that_panics_is_an_error_and_frees_its_slot() {
        let compute = ComputePool::new(1, 1);
        assert_eq!(
            compute.run(|| -> u8 { panic!("on purpose") }).await,
            Err(ComputeError::Panicked)
        );
        assert_eq!(compute.run(|| 7).await, Ok(7));
    }

    #[tokio::test]
    async fn more_work_than_may_wait_is_refused() {
        let compute = ComputePool::new(1, 0);
        let (go, gone) = std::sync::mpsc::channel::<()>();
        let first = tokio::spawn({
            let compute = compute.clone();
            async move { compute.run(move || gone.recv().is_ok()).await }
        });
        tokio::task::yield_now().await;
        assert_eq!(compute.run(|| 7).await, Err(ComputeError::QueueFull(0)));
        assert_eq!(compute.waiting(), 0);
        go.send(()).unwrap();
        assert_eq!(first.await.unwrap(), Ok(true));
    }
}
