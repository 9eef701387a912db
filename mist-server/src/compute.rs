//! Computations, each on threads of its own, away from the threads that answer requests.

mod turns;
mod work_pool;

use std::{
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};

use tokio::sync::oneshot;

pub(crate) use turns::{ComputeLimits, WorkSize};
use turns::{Crowded, Turns};
pub(crate) use work_pool::{WorkFailure, WorkPool};

/// Threads that are kept for the next computations.
const IDLE_POOLS: usize = 4;
/// A computation that takes longer was not small.
const SMALL_TIME: Duration = Duration::from_millis(300);

/// Runs computations, a bounded number at a time, in fair turns; clones share it.
#[derive(Clone, Debug)]
pub(crate) struct ComputePool(Arc<Shared>);

#[derive(Debug)]
struct Shared {
    turns: Mutex<Turns>,
    idle: Mutex<Vec<Arc<WorkPool>>>,
}

/// A computation as the pool sees it.
#[derive(Debug)]
pub(crate) struct WorkRequest {
    /// The client for which it runs.
    pub(crate) client: String,
    /// Its estimated size.
    pub(crate) size: WorkSize,
    /// Longest time for which it may run.
    pub(crate) time: Duration,
    /// Ends it when it is set.
    pub(crate) cancel: Arc<AtomicBool>,
}

/// The reason why a computation has no result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum ComputeError {
    /// It panicked.
    #[error("the computation broke down")]
    Panicked,
    /// It was not begun: too many of this client wait already.
    #[error("too many computations of this client wait")]
    ClientQueueFull,
    /// It was not begun: too many wait already.
    #[error("too many computations wait")]
    QueueFull,
    /// It took longer than allowed.
    #[error("the computation takes too long")]
    TooLong,
    /// It was cancelled.
    #[error("the computation was cancelled")]
    Cancelled,
    /// The system has no threads for it.
    #[error("the system has no threads for the computation")]
    NoThreads,
}

/// A computation that waits or runs; dropping it ends the computation.
struct AdmittedWork {
    shared: Arc<Shared>,
    client: String,
    size: WorkSize,
}

/// Sets its flag when nobody waits for the result any more.
struct CancelOnDrop(Arc<AtomicBool>);

impl Drop for CancelOnDrop {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

impl Drop for AdmittedWork {
    fn drop(&mut self) {
        self.shared.turns().leave(&self.client, self.size);
    }
}

impl Shared {
    fn turns(&self) -> MutexGuard<'_, Turns> {
        self.turns.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn idle(&self) -> MutexGuard<'_, Vec<Arc<WorkPool>>> {
        self.idle.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn threads(&self) -> Result<Arc<WorkPool>, ComputeError> {
        let kept = self.idle().pop();
        kept.map_or_else(|| WorkPool::new().map(Arc::new).map_err(|_| ComputeError::NoThreads), Ok)
    }

    /// Keeps threads for the next computation.
    fn keep(&self, threads: Arc<WorkPool>) {
        let mut idle = self.idle();
        if idle.len() < IDLE_POOLS {
            idle.push(threads);
        }
    }
}

impl ComputePool {
    /// At most so many computations at a time.
    pub(crate) fn new(limits: ComputeLimits) -> Self {
        let shared = Shared { turns: Mutex::new(Turns::new(limits)), idle: Mutex::default() };
        Self(Arc::new(shared))
    }

    /// Number of computations that run.
    pub(crate) fn running(&self) -> usize {
        self.0.turns().running()
    }

    /// Number of computations that wait.
    pub(crate) fn waiting(&self) -> usize {
        self.0.turns().waiting()
    }

    /// True if a computation could begin or wait now.
    pub(crate) fn accepts_work(&self) -> bool {
        self.0.threads().is_ok_and(|threads| {
            self.0.keep(threads);
            true
        })
    }

    /// Runs `work` at the turn of its client. When the future is dropped, or takes too long, its
    /// flag is set and it ends at the next check of the flag.
    pub(crate) async fn run<T: Send + 'static>(
        &self,
        request: WorkRequest,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T, ComputeError> {
        let WorkRequest { client, size, time, cancel } = request;
        let _cancel = CancelOnDrop(cancel.clone());
        let begun = self.0.turns().enter(&client, size).map_err(|crowded| match crowded {
            Crowded::Client => ComputeError::ClientQueueFull,
            Crowded::Service => ComputeError::QueueFull,
        })?;
        let mut turn = PendingTurn { begun: Some(begun), shared: &self.0, client: &client, size };
        let place = turn.wait().await;
        if cancel.load(Ordering::Relaxed) {
            return Err(ComputeError::Cancelled);
        }
        let threads = self.0.threads()?;
        let (answer, mut answered) = oneshot::channel();
        let place = Arc::new(Mutex::new(place));
        let (held, shared, own) = (place.clone(), self.0.clone(), threads.clone());
        threads.start(cancel, work, move |done| {
            // The place is free before the next computation can know of the result.
            shared.keep(own);
            drop(held);
            // A receiver that is gone needs no answer.
            let _ = answer.send(done);
        });
        let place = Arc::downgrade(&place);
        let done = async {
            if size == WorkSize::Small {
                match tokio::time::timeout(SMALL_TIME, &mut answered).await {
                    Ok(done) => return done,
                    Err(_) => outgrow(&place),
                }
            }
            answered.await
        };
        match tokio::time::timeout(time, done).await {
            Err(_) => Err(ComputeError::TooLong),
            Ok(Ok(Ok(done))) => Ok(done),
            Ok(Ok(Err(WorkFailure::Interrupted))) => Err(ComputeError::Cancelled),
            Ok(Ok(Err(WorkFailure::Panicked)) | Err(_)) => Err(ComputeError::Panicked),
        }
    }
}

/// Frees the place of a small computation for others, as it takes long.
fn outgrow(place: &std::sync::Weak<Mutex<AdmittedWork>>) {
    let Some(place) = place.upgrade() else { return };
    let mut place = place.lock().unwrap_or_else(PoisonError::into_inner);
    place.size = WorkSize::Large;
    let client = place.client.clone();
    place.shared.turns().outgrow(&client);
}

/// A computation that waits for its turn; one that was begun while its future was dropped leaves.
struct PendingTurn<'a> {
    begun: Option<oneshot::Receiver<()>>,
    shared: &'a Arc<Shared>,
    client: &'a str,
    size: WorkSize,
}

impl PendingTurn<'_> {
    async fn wait(&mut self) -> AdmittedWork {
        if let Some(begun) = &mut self.begun {
            // The sender is dropped only with the whole pool.
            let _ = begun.await;
        }
        self.begun = None;
        AdmittedWork {
            shared: self.shared.clone(),
            client: self.client.to_owned(),
            size: self.size,
        }
    }
}

impl Drop for PendingTurn<'_> {
    fn drop(&mut self) {
        let Some(mut begun) = self.begun.take() else { return };
        begun.close();
        if begun.try_recv().is_ok() {
            self.shared.turns().leave(self.client, self.size);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: ComputeLimits =
        ComputeLimits { running: 1, client_running: 1, waiting: 1, client_waiting: 1 };

    fn request(time: u64) -> WorkRequest {
        WorkRequest {
            client: "a".into(),
            size: WorkSize::Large,
            time: Duration::from_millis(time),
            cancel: Arc::default(),
        }
    }

    /// Work that ends when it is interrupted.
    fn endless() {
        loop {
            scattering::interrupt::check();
            std::thread::yield_now();
        }
    }

    #[tokio::test]
    async fn work_that_panics_is_an_error_and_frees_its_place() {
        let compute = ComputePool::new(LIMITS);
        let failed = compute.run(request(60_000), || -> u8 { panic!("on purpose") }).await;
        assert_eq!(failed, Err(ComputeError::Panicked));
        assert_eq!(compute.run(request(60_000), || 7).await, Ok(7));
    }

    #[tokio::test]
    async fn work_ends_at_its_time_limit_and_when_nobody_waits_for_it() {
        let compute = ComputePool::new(LIMITS);
        assert_eq!(compute.run(request(50), endless).await, Err(ComputeError::TooLong));
        let left = compute.run(request(60_000), endless);
        assert!(tokio::time::timeout(Duration::from_millis(50), left).await.is_err());
        // There is one place: this begins after the others have ended.
        assert_eq!(compute.run(request(60_000), || 7).await, Ok(7));
    }

    #[tokio::test]
    async fn parts_on_other_threads_are_interrupted_too() {
        use rayon::prelude::*;
        let compute = ComputePool::new(LIMITS);
        let work = || (0..8).into_par_iter().for_each(|_| endless());
        assert_eq!(compute.run(request(50), work).await, Err(ComputeError::TooLong));
        assert_eq!(compute.run(request(60_000), || 7).await, Ok(7));
    }

    #[tokio::test]
    async fn more_work_than_may_wait_is_refused() {
        let compute = ComputePool::new(LIMITS);
        let spawn = |compute: &ComputePool| {
            let compute = compute.clone();
            tokio::spawn(async move { compute.run(request(60_000), endless).await })
        };
        let (first, second) = (spawn(&compute), spawn(&compute));
        while compute.waiting() == 0 {
            tokio::task::yield_now().await;
        }
        assert_eq!(compute.run(request(1), || 7).await, Err(ComputeError::ClientQueueFull));
        first.abort();
        second.abort();
        let _ = (first.await, second.await);
        assert_eq!(compute.run(request(60_000), || 7).await, Ok(7));
    }
}
