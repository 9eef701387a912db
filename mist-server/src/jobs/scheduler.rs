//! The state that all jobs and their worker threads share.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, atomic::Ordering};

use tokio::sync::watch;

use super::{
    job::{JobRecord, ServiceJob},
    queue::JobQueue,
    status::{JobState, JobStatus},
};
use crate::{
    limits::ServeLimits,
    output::BoundedOutput,
    store::{Store, StoreError},
};

/// Gives jobs to worker threads and stores their ends.
pub(super) struct Scheduler {
    pub(super) store: Store,
    pub(super) limits: Arc<ServeLimits>,
    queue: Mutex<JobQueue>,
    /// Signals that the queue has a job, that a worker has ended, or that the service stops.
    changed: Condvar,
    /// Becomes true when the clients that follow jobs are to leave.
    pub(super) leaving: watch::Sender<bool>,
}

impl Scheduler {
    /// The jobs in `store`; those that were not over wait again.
    ///
    /// # Errors
    ///
    /// If they cannot be read.
    pub(super) fn open(store: Store, limits: Arc<ServeLimits>) -> Result<Self, StoreError> {
        let mut queue = JobQueue::default();
        let mut records: Vec<JobRecord> = Vec::new();
        for (id, text) in store.jobs()? {
            match serde_json::from_str(&text) {
                Ok(record) => records.push(record),
                Err(error) => tracing::warn!(
                    id,
                    %error,
                    "the record of a job cannot be read; it stays in the store: submit it again"
                ),
            }
        }
        records.sort_by_key(|record| record.number);
        for record in records {
            queue.restore(record);
        }
        Ok(Self {
            store,
            limits,
            queue: Mutex::new(queue),
            changed: Condvar::new(),
            leaving: watch::Sender::new(false),
        })
    }

    pub(super) fn queue(&self) -> MutexGuard<'_, JobQueue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Appends a job to those that wait.
    pub(super) fn enqueue(&self, job: Arc<ServiceJob>) {
        self.queue().waiting.push_back(job);
        self.changed.notify_one();
    }

    /// The next job to run; none when the service stops.
    pub(super) fn next(&self) -> Option<Arc<ServiceJob>> {
        let mut queue = self.queue();
        loop {
            if queue.stopping {
                return None;
            }
            if let Some(job) = queue.take_next() {
                job.status.send_modify(JobStatus::start);
                return Some(job);
            }
            queue = self.changed.wait(queue).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Ends a job: its record and its texts are stored, then its followers are told.
    pub(super) fn finish(
        &self,
        job: &ServiceJob,
        state: JobState,
        change: impl FnOnce(&mut JobStatus),
        texts: &[(String, String)],
    ) {
        let mut status = job.status();
        status.finish(state);
        change(&mut status);
        let bytes = texts.iter().map(|(_, text)| text.len() as u64).sum();
        job.bytes.fetch_add(bytes, Ordering::Relaxed);
        self.queue().stored += bytes;
        let record = job.record(status.clone());
        if let Err(error) = self.store.finish_job(&job.id, &record, texts) {
            tracing::error!(id = job.id, %error, "the end of a job cannot be stored");
            status.lose_texts(&error.to_string());
        }
        *job.output.lock().unwrap_or_else(PoisonError::into_inner) = BoundedOutput::default();
        job.status.send_replace(status);
    }

    /// Counts a job that is over, and removes the oldest of too many.
    pub(super) fn retire(&self, job: &ServiceJob) {
        if !job.status.borrow().state.is_over() {
            return;
        }
        let removed = self.queue().retire(&self.limits, &job.id);
        for id in removed {
            if let Err(error) = self.store.remove_job(&id) {
                tracing::warn!(id, %error, "an old job cannot be removed");
            }
        }
    }

    /// Counts a worker that has ended.
    pub(super) fn worker_ended(&self) {
        self.queue().workers -= 1;
        self.changed.notify_all();
    }

    /// Stops the jobs that run, and waits until their workers have ended.
    pub(super) fn stop(&self) {
        let mut queue = self.queue();
        queue.stopping = true;
        for job in queue.jobs.values() {
            if job.status.borrow().state == JobState::Running {
                job.cancel.store(true, Ordering::Relaxed);
            }
        }
        self.changed.notify_all();
        while queue.workers > 0 {
            queue = self.changed.wait(queue).unwrap_or_else(PoisonError::into_inner);
        }
    }
}
