//! All jobs, those that wait, those that are over, and the limits on their numbers.

use std::{
    collections::{BTreeMap, VecDeque},
    sync::{Arc, atomic::Ordering},
};

use super::{
    error::JobsError,
    job::{JobRecord, ServiceJob},
    status::{JobState, JobStatus},
};
use crate::limits::{LimitReached, ServeLimits};

/// All jobs of the service.
#[derive(Default)]
pub(super) struct JobQueue {
    pub(super) jobs: BTreeMap<String, Arc<ServiceJob>>,
    /// Jobs that wait, in the order in which they run.
    pub(super) waiting: VecDeque<Arc<ServiceJob>>,
    /// Number of the last job that has begun, by client, while others wait.
    last_begun: BTreeMap<String, u64>,
    /// Jobs that have begun.
    begun: u64,
    /// Jobs that are over, the oldest first.
    pub(super) over: VecDeque<String>,
    /// Bytes of the programs and texts of all jobs.
    pub(super) stored: u64,
    next: u64,
    pub(super) stopping: bool,
    pub(super) workers: usize,
}

impl JobQueue {
    /// Adds a job from the store; one that was not over waits again.
    pub(super) fn restore(&mut self, mut record: JobRecord) {
        self.next = record.number + 1;
        self.stored += record.bytes;
        let over = record.status.state.is_over();
        if !over {
            record.status.state = JobState::Queued;
        }
        let job = Arc::new(ServiceJob::new(record));
        self.jobs.insert(job.id.clone(), job.clone());
        if over {
            self.over.push_back(job.id.clone());
        } else {
            self.waiting.push_back(job);
        }
    }

    /// Adds a new job; it counts from now on but does not wait yet.
    pub(super) fn add(&mut self, client: String, bytes: u64, status: JobStatus) -> Arc<ServiceJob> {
        let record = JobRecord { number: self.next, client, bytes, status };
        self.next += 1;
        self.stored += bytes;
        let job = Arc::new(ServiceJob::new(record));
        self.jobs.insert(job.id.clone(), job.clone());
        job
    }

    /// Refuses a job of `client` if it would not be accepted now.
    ///
    /// # Errors
    ///
    /// If the service stops or too many wait.
    pub(super) fn admit(&self, limits: &ServeLimits, client: &str) -> Result<(), JobsError> {
        if self.stopping {
            return Err(JobsError::Stopping);
        }
        if self.waiting.len() >= limits.max_queued {
            let message = "too many jobs wait".into();
            let value = limits.max_queued as f64;
            return Err(JobsError::Full(LimitReached { flag: "max-queued", value, message }));
        }
        // A job that has just ended is not among those over yet, but makes room like them.
        let is_full = self.stored >= limits.max_stored;
        if is_full && self.jobs.values().all(|job| !job.status.borrow().state.is_over()) {
            let message = "the jobs that wait or run fill the store".into();
            let value = limits.max_stored as f64;
            return Err(JobsError::Full(LimitReached { flag: "max-stored", value, message }));
        }
        let open = self.jobs.values().filter(|job| !job.status.borrow().state.is_over());
        if open.filter(|job| job.client == client).count() >= limits.max_client_jobs {
            let message = "this client has too many jobs that wait or run".into();
            let value = limits.max_client_jobs as f64;
            return Err(JobsError::Full(LimitReached { flag: "max-client-jobs", value, message }));
        }
        Ok(())
    }

    /// Takes the next job from those that wait: the oldest one of the client whose last job began
    /// first.
    pub(super) fn take_next(&mut self) -> Option<Arc<ServiceJob>> {
        let last = |job: &ServiceJob| self.last_begun.get(&job.client).copied();
        let next = (0..self.waiting.len()).min_by_key(|at| last(&self.waiting[*at]))?;
        let job = self.waiting.remove(next)?;
        self.begun += 1;
        self.last_begun.insert(job.client.clone(), self.begun);
        if self.waiting.is_empty() {
            self.last_begun.clear();
        }
        Some(job)
    }

    /// Removes a job from those that wait; false if it was not among them.
    pub(super) fn stop_waiting(&mut self, id: &str) -> bool {
        let before = self.waiting.len();
        self.waiting.retain(|other| other.id != id);
        self.waiting.len() < before
    }

    /// Marks a job as over and removes the oldest of too many; gives the ids of these.
    pub(super) fn retire(&mut self, limits: &ServeLimits, id: &str) -> Vec<String> {
        let mut removed = Vec::new();
        self.over.push_back(id.into());
        while self.over.len() > limits.max_finished
            || (self.stored > limits.max_stored && self.over.len() > 1)
        {
            let Some(id) = self.over.pop_front() else { break };
            self.remove(&id);
            removed.push(id);
        }
        removed
    }

    /// Removes a job and the bytes that it occupies.
    pub(super) fn remove(&mut self, id: &str) {
        if let Some(job) = self.jobs.remove(id) {
            self.stored -= job.bytes.load(Ordering::Relaxed);
        }
        self.over.retain(|other| other != id);
    }
}
