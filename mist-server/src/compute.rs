//! Heavy work away from the threads that answer requests.

use std::sync::Arc;

use tokio::sync::{Semaphore, oneshot};

/// Runs closures on rayon's threads, a few at a time.
#[derive(Clone, Debug)]
pub(crate) struct Compute {
    places: Arc<Semaphore>,
}

/// The work ended without an answer: it panicked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the computation broke down")]
pub(crate) struct Panicked;

impl Compute {
    /// At most `places` pieces of work at a time; each uses all threads.
    pub(crate) fn new(places: usize) -> Self {
        Self { places: Arc::new(Semaphore::new(places)) }
    }

    /// Runs `work` when there is a place for it.
    pub(crate) async fn run<T: Send + 'static>(
        &self,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T, Panicked> {
        // The semaphore is never closed.
        let place = self.places.clone().acquire_owned().await.map_err(|_| Panicked)?;
        let (answer, answered) = oneshot::channel();
        rayon::spawn(move || {
            let _place = place;
            let done = std::panic::catch_unwind(std::panic::AssertUnwindSafe(work));
            // On a panic the sender is dropped; a receiver that is gone wants nothing.
            if let Ok(done) = done {
                let _ = answer.send(done);
            }
        });
        answered.await.map_err(|_| Panicked)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn work_that_panics_is_an_error_and_frees_its_place() {
        let compute = Compute::new(1);
        assert_eq!(compute.run(|| -> u8 { panic!("on purpose") }).await, Err(Panicked));
        assert_eq!(compute.run(|| 7).await, Ok(7));
    }
}
