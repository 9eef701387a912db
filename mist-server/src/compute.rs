//! Heavy work away from the threads that answer requests.

use std::sync::{
    Arc,
    atomic::{AtomicUsize, Ordering},
};

use tokio::sync::{OwnedSemaphorePermit, Semaphore, oneshot};

/// Runs closures on rayon's threads, a few at a time.
#[derive(Clone, Debug)]
pub(crate) struct Compute {
    places: Arc<Semaphore>,
    waiting: Arc<AtomicUsize>,
    most_waiting: usize,
}

/// The work ended without an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum NotDone {
    /// It panicked.
    #[error("the computation broke down")]
    Panicked,
    /// It was not begun: this many wait already.
    #[error("{0} computations wait already")]
    Busy(usize),
}

/// Counts a piece of work while it waits.
struct Waiting(Arc<AtomicUsize>);

impl Drop for Waiting {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

impl Compute {
    /// At most `places` pieces of work at a time, each using all threads, while at most
    /// `most_waiting` wait.
    pub(crate) fn new(places: usize, most_waiting: usize) -> Self {
        let places = Arc::new(Semaphore::new(places.max(1)));
        Self { places, waiting: Arc::default(), most_waiting }
    }

    /// How many pieces of work wait.
    pub(crate) fn waiting(&self) -> usize {
        self.waiting.load(Ordering::Relaxed)
    }

    /// Runs `work` when there is a place for it.
    pub(crate) async fn run<T: Send + 'static>(
        &self,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T, NotDone> {
        let place = match self.places.clone().try_acquire_owned() {
            Ok(place) => place,
            Err(_) => self.wait().await?,
        };
        let (answer, answered) = oneshot::channel();
        rayon::spawn(move || {
            let _place = place;
            let done = std::panic::catch_unwind(std::panic::AssertUnwindSafe(work));
            // On a panic the sender is dropped; a receiver that is gone wants nothing.
            if let Ok(done) = done {
                let _ = answer.send(done);
            }
        });
        answered.await.map_err(|_| NotDone::Panicked)
    }

    async fn wait(&self) -> Result<OwnedSemaphorePermit, NotDone> {
        let before = self.waiting.fetch_add(1, Ordering::Relaxed);
        let _waiting = Waiting(self.waiting.clone());
        if before >= self.most_waiting {
            return Err(NotDone::Busy(self.most_waiting));
        }
        // The semaphore is never closed.
        self.places.clone().acquire_owned().await.map_err(|_| NotDone::Panicked)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn work_that_panics_is_an_error_and_frees_its_place() {
        let compute = Compute::new(1, 1);
        assert_eq!(compute.run(|| -> u8 { panic!("on purpose") }).await, Err(NotDone::Panicked));
        assert_eq!(compute.run(|| 7).await, Ok(7));
    }

    #[tokio::test]
    async fn more_work_than_may_wait_is_refused_and_leaves_no_trace() {
        let compute = Compute::new(1, 0);
        let (go, gone) = std::sync::mpsc::channel::<()>();
        let first = tokio::spawn({
            let compute = compute.clone();
            async move { compute.run(move || gone.recv().is_ok()).await }
        });
        tokio::task::yield_now().await;
        assert_eq!(compute.run(|| 7).await, Err(NotDone::Busy(0)));
        assert_eq!(compute.waiting(), 0);
        go.send(()).unwrap();
        assert_eq!(first.await.unwrap(), Ok(true));
    }
}
