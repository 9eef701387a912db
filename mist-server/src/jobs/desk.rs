//! Which jobs there are, wait, and are over, and whether there is room for one more.

use std::{
    collections::{BTreeMap, VecDeque},
    sync::{Arc, atomic::Ordering},
};

use super::{
    State, Status,
    job::{Job, Record},
};
use crate::{
    http::{ApiError, Limit},
    limits::ServeLimits,
};

/// What is known of all jobs at one moment.
#[derive(Default)]
pub(super) struct Desk {
    pub(super) jobs: BTreeMap<String, Arc<Job>>,
    pub(super) queue: VecDeque<Arc<Job>>,
    /// Jobs that are over, the oldest first.
    pub(super) over: VecDeque<String>,
    /// Bytes of the programs and texts of all jobs.
    pub(super) stored: u64,
    next: u64,
    pub(super) stopping: bool,
    pub(super) workers: usize,
}

impl Desk {
    /// Takes up a job that is kept; one that was not over waits again.
    pub(super) fn take_up(&mut self, mut record: Record) {
        self.next = record.number + 1;
        self.stored += record.bytes;
        let over = record.status.state.is_over();
        if !over {
            record.status.state = State::Queued;
        }
        let job = Arc::new(Job::new(record));
        self.jobs.insert(job.id.clone(), job.clone());
        if over {
            self.over.push_back(job.id.clone());
        } else {
            self.queue.push_back(job);
        }
    }

    /// Enters a new job; it counts from now on but does not wait in the queue yet.
    pub(super) fn enter(&mut self, client: String, bytes: u64, status: Status) -> Arc<Job> {
        let record = Record { number: self.next, client, bytes, status };
        self.next += 1;
        self.stored += bytes;
        let job = Arc::new(Job::new(record));
        self.jobs.insert(job.id.clone(), job.clone());
        job
    }

    /// Whether a job of `client` would be accepted now.
    ///
    /// # Errors
    ///
    /// If the service stops or too many wait.
    pub(super) fn admit(&self, limits: &ServeLimits, client: &str) -> Result<(), ApiError> {
        if self.stopping {
            return Err(ApiError::Unavailable("the service is stopping".into()));
        }
        if self.queue.len() >= limits.max_queued {
            let message = "too many jobs wait".into();
            let value = limits.max_queued as f64;
            return Err(ApiError::TooMany(Limit { flag: "max-queued", value, message }));
        }
        if self.over.is_empty() && self.stored >= limits.max_stored {
            let message = "the jobs that wait or run fill the store".into();
            let value = limits.max_stored as f64;
            return Err(ApiError::TooMany(Limit { flag: "max-stored", value, message }));
        }
        let open = self.jobs.values().filter(|job| !job.status.borrow().state.is_over());
        if open.filter(|job| job.client == client).count() >= limits.max_client_jobs {
            let message = "this client has too many jobs that wait or run".into();
            let value = limits.max_client_jobs as f64;
            return Err(ApiError::TooMany(Limit { flag: "max-client-jobs", value, message }));
        }
        Ok(())
    }

    /// Takes a job out of the queue; whether it was there.
    pub(super) fn unqueue(&mut self, id: &str) -> bool {
        let before = self.queue.len();
        self.queue.retain(|other| other.id != id);
        self.queue.len() < before
    }

    /// Notes that a job is over and forgets the oldest of too many; the ids of these.
    pub(super) fn retire(&mut self, limits: &ServeLimits, id: &str) -> Vec<String> {
        let mut forgotten = Vec::new();
        self.over.push_back(id.into());
        while self.over.len() > limits.max_finished
            || (self.stored > limits.max_stored && self.over.len() > 1)
        {
            let Some(id) = self.over.pop_front() else { break };
            self.remove(&id);
            forgotten.push(id);
        }
        forgotten
    }

    /// Forgets a job and what it occupies.
    pub(super) fn remove(&mut self, id: &str) {
        if let Some(job) = self.jobs.remove(id) {
            self.stored -= job.bytes.load(Ordering::Relaxed);
        }
        self.over.retain(|other| other != id);
    }
}
