//! The jobs of the service as its clients see them.

use std::sync::{Arc, atomic::Ordering};

use mist_engine::request::ProgramDescription;

use super::{
    error::JobsError,
    job::{ServiceJob, json},
    scheduler::Scheduler,
    status::{JobState, JobStatus},
    worker,
};
use crate::{
    compute::WorkPool,
    keys::hexadecimal,
    limits::ServeLimits,
    store::{Store, StoreError},
};

/// Random bytes of an id.
const ID_BYTES: usize = 12;

/// All jobs; clones share them.
#[derive(Clone)]
pub(crate) struct Jobs(Arc<Scheduler>);

impl Jobs {
    /// The jobs in `store`; those that were not over wait again.
    ///
    /// # Errors
    ///
    /// If they cannot be read.
    pub(crate) fn open(store: Store, limits: Arc<ServeLimits>) -> Result<Self, StoreError> {
        Scheduler::open(store, limits).map(|scheduler| Self(Arc::new(scheduler)))
    }

    /// Starts the threads that run jobs.
    pub(crate) fn start(&self) {
        for number in 0..self.0.limits.max_running {
            let scheduler = self.0.clone();
            self.0.queue().workers += 1;
            let name = format!("mist-job-{number}");
            let started = std::thread::Builder::new().name(name).spawn(move || {
                match WorkPool::new() {
                    Ok(threads) => {
                        while let Some(job) = scheduler.next() {
                            worker::run(&scheduler, &job, &threads);
                            scheduler.retire(&job);
                        }
                    }
                    Err(error) => tracing::error!(%error, "no threads for jobs"),
                }
                scheduler.worker_ended();
            });
            if let Err(error) = started {
                self.0.worker_ended();
                tracing::error!(%error, "no thread for jobs");
            }
        }
    }

    /// Accepts a job of `client`.
    ///
    /// # Errors
    ///
    /// If too many wait, or it cannot be stored.
    pub(crate) fn submit(
        &self,
        request: &ProgramDescription,
        client: String,
    ) -> Result<JobStatus, JobsError> {
        let mut id = [0; ID_BYTES];
        getrandom::fill(&mut id).map_err(|error| JobsError::NoRandomNumbers(error.to_string()))?;
        let program = json(request);
        let bytes = program.len() as u64;
        let job = {
            let mut queue = self.0.queue();
            queue.admit(&self.0.limits, &client)?;
            let status = JobStatus::new(hexadecimal(&id), request.job.clone());
            queue.add(client, bytes, status)
        };
        if let Err(error) = self.0.store.put_job(&job.id, &job.record(job.status()), &program) {
            self.0.queue().remove(&job.id);
            return Err(error.into());
        }
        self.0.enqueue(job.clone());
        Ok(job.status())
    }

    /// Refuses a job of `client` if it would not be accepted now.
    ///
    /// # Errors
    ///
    /// If too many wait.
    pub(crate) fn admit(&self, client: &str) -> Result<(), JobsError> {
        self.0.queue().admit(&self.0.limits, client)
    }

    /// The job with this id.
    pub(crate) fn find(&self, id: &str) -> Result<Arc<ServiceJob>, JobsError> {
        let found = self.0.queue().jobs.get(id).cloned();
        found.ok_or_else(|| JobsError::Unknown(id.to_owned()))
    }

    /// The status of every job, the oldest first.
    pub(crate) fn list(&self) -> Vec<JobStatus> {
        let mut jobs: Vec<Arc<ServiceJob>> = self.0.queue().jobs.values().cloned().collect();
        jobs.sort_by_key(|job| job.number);
        jobs.iter().map(|job| job.status()).collect()
    }

    /// The number of jobs in each state.
    pub(crate) fn counts(&self) -> Vec<(&'static str, usize)> {
        let queue = self.0.queue();
        let count = |state: JobState| {
            queue.jobs.values().filter(|job| job.status.borrow().state == state).count()
        };
        JobState::ALL.map(|state| (state.name(), count(state))).to_vec()
    }

    /// A text of a job that is over.
    pub(crate) fn text(&self, job: &ServiceJob, kind: &str) -> Result<Option<String>, StoreError> {
        self.0.store.text(&job.id, kind)
    }

    /// Cancels a job that waits or runs; removes one that is over.
    ///
    /// # Errors
    ///
    /// If the change cannot be stored.
    pub(crate) fn cancel(&self, job: &Arc<ServiceJob>) -> Result<JobStatus, JobsError> {
        if job.status().state.is_over() {
            self.0.store.remove_job(&job.id)?;
            self.0.queue().remove(&job.id);
            return Ok(job.status());
        }
        job.cancel.store(true, Ordering::Relaxed);
        let was_waiting = self.0.queue().stop_waiting(&job.id);
        if was_waiting {
            self.0.finish(job, JobState::Cancelled, |_| (), &[]);
            self.0.retire(job);
        }
        Ok(job.status())
    }

    /// Ends the futures of [`Jobs::left`].
    pub(crate) fn leave(&self) {
        self.0.leaving.send_replace(true);
    }

    /// Waits until the clients that follow jobs are to leave.
    pub(crate) fn left(&self) -> impl Future<Output = ()> + use<> {
        let mut leaving = self.0.leaving.subscribe();
        async move {
            let _ = leaving.wait_for(|leaving| *leaving).await;
        }
    }

    /// True when no more jobs are accepted.
    pub(crate) fn is_stopping(&self) -> bool {
        self.0.queue().stopping
    }

    /// Stops the jobs that run; their finished steps are stored, and they continue when the
    /// service starts again. Returns when they have stopped.
    pub(crate) fn stop(&self) {
        self.0.stop();
    }
}
