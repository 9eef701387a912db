//! Programs that run in the background and outlive the service.
//!
//! A job is kept from the moment it is accepted; its finished steps are kept while it runs, its
//! texts when it is over. A service that starts takes up the jobs that were not over, in the
//! order in which they came.

mod desk;
mod job;
mod ledger;
mod run;
mod sink;
mod status;

pub(crate) use job::Job;
pub(crate) use sink::MeasuredSink;
pub(crate) use status::{State, Status};

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, atomic::Ordering};

use tokio::sync::watch;

use self::{
    desk::Desk,
    job::{Record, json},
};
use crate::store::{Store, StoreError};
use crate::{
    http::{ApiError, ProgramBody},
    keys::hexadecimal,
    limits::ServeLimits,
};

/// Random bytes of an id.
const ID_BYTES: usize = 12;

/// All jobs; clones are the same.
#[derive(Clone)]
pub(crate) struct Jobs(Arc<Office>);

/// What handlers and workers share.
struct Office {
    store: Store,
    limits: Arc<ServeLimits>,
    desk: Mutex<Desk>,
    /// There is a job to run, or none will come any more.
    bell: Condvar,
    /// The service takes leave of those who follow its jobs.
    leaving: watch::Sender<bool>,
}

impl Jobs {
    /// The jobs in `store`; those that were not over wait again.
    ///
    /// # Errors
    ///
    /// If they cannot be read.
    pub(crate) fn open(store: Store, limits: Arc<ServeLimits>) -> Result<Self, StoreError> {
        let mut desk = Desk::default();
        let mut records: Vec<Record> = Vec::new();
        for (id, text) in store.jobs()? {
            match serde_json::from_str(&text) {
                Ok(record) => records.push(record),
                Err(error) => tracing::warn!(id, %error, "a job cannot be read"),
            }
        }
        records.sort_by_key(|record| record.number);
        for record in records {
            desk.take_up(record);
        }
        let desk = Mutex::new(desk);
        Ok(Self(Arc::new(Office {
            store,
            limits,
            desk,
            bell: Condvar::new(),
            leaving: watch::Sender::new(false),
        })))
    }

    /// Starts the threads that run jobs.
    pub(crate) fn start(&self) {
        for number in 0..self.0.limits.max_running {
            let office = self.0.clone();
            self.desk().workers += 1;
            let name = format!("mist-job-{number}");
            let started = std::thread::Builder::new().name(name).spawn(move || {
                while let Some(job) = office.next() {
                    run::run(&office, &job);
                    office.over(&job);
                }
                office.desk().workers -= 1;
                office.bell.notify_all();
            });
            if let Err(error) = started {
                self.desk().workers -= 1;
                tracing::error!(%error, "no thread for jobs");
            }
        }
    }

    /// Accepts a job of `client`.
    ///
    /// # Errors
    ///
    /// If too many wait, or it cannot be kept.
    pub(crate) fn submit(&self, body: &ProgramBody, client: String) -> Result<Status, ApiError> {
        let mut id = [0; ID_BYTES];
        getrandom::fill(&mut id).map_err(|error| ApiError::Failed(error.to_string()))?;
        let program = json(body);
        let bytes = program.len() as u64;
        let job = {
            let mut desk = self.desk();
            desk.admit(&self.0.limits, &client)?;
            let status = Status::new(hexadecimal(&id), body.job.clone());
            desk.enter(client, bytes, status)
        };
        if let Err(error) = self.0.store.put_job(&job.id, &job.record(job.status()), &program) {
            self.desk().remove(&job.id);
            return Err(error.into());
        }
        self.desk().queue.push_back(job.clone());
        self.0.bell.notify_one();
        Ok(job.status())
    }

    /// Whether a job of `client` would be accepted now.
    ///
    /// # Errors
    ///
    /// If too many wait.
    pub(crate) fn admit(&self, client: &str) -> Result<(), ApiError> {
        self.desk().admit(&self.0.limits, client)
    }

    /// The job with this id.
    pub(crate) fn find(&self, id: &str) -> Result<Arc<Job>, ApiError> {
        let found = self.desk().jobs.get(id).cloned();
        found.ok_or_else(|| ApiError::NotFound(format!("job {id:?}")))
    }

    /// Every job, the oldest first.
    pub(crate) fn list(&self) -> Vec<Status> {
        let mut jobs: Vec<Arc<Job>> = self.desk().jobs.values().cloned().collect();
        jobs.sort_by_key(|job| job.number);
        jobs.iter().map(|job| job.status()).collect()
    }

    /// How many jobs there are in each state.
    pub(crate) fn counts(&self) -> Vec<(&'static str, usize)> {
        let desk = self.desk();
        let count = |state: State| {
            desk.jobs.values().filter(|job| job.status.borrow().state == state).count()
        };
        State::ALL.map(|state| (state.name(), count(state))).to_vec()
    }

    /// A text of a job that is over.
    pub(crate) fn text(&self, job: &Job, kind: &str) -> Result<Option<String>, StoreError> {
        self.0.store.text(&job.id, kind)
    }

    /// Cancels a job that waits or runs; forgets one that is over.
    ///
    /// # Errors
    ///
    /// If it cannot be kept.
    pub(crate) fn cancel(&self, job: &Arc<Job>) -> Result<Status, ApiError> {
        if job.status().state.is_over() {
            self.0.store.remove_job(&job.id)?;
            self.desk().remove(&job.id);
            return Ok(job.status());
        }
        job.cancel.store(true, Ordering::Relaxed);
        let waited = self.desk().unqueue(&job.id);
        if waited {
            self.0.finish(job, State::Cancelled, |_| (), &[]);
            self.0.over(job);
        }
        Ok(job.status())
    }

    /// Ends what waits for [`Jobs::left`].
    pub(crate) fn leave(&self) {
        self.0.leaving.send_replace(true);
    }

    /// Waits until the service takes leave of those who follow its jobs.
    pub(crate) fn left(&self) -> impl Future<Output = ()> + use<> {
        let mut leaving = self.0.leaving.subscribe();
        async move {
            let _ = leaving.wait_for(|leaving| *leaving).await;
        }
    }

    /// Whether no more jobs are accepted.
    pub(crate) fn is_stopping(&self) -> bool {
        self.desk().stopping
    }

    /// Stops the jobs that run; what they finished is kept, and they go on when the service
    /// starts again. Returns when they have stopped.
    pub(crate) fn stop(&self) {
        let mut desk = self.desk();
        desk.stopping = true;
        for job in desk.jobs.values() {
            if job.status.borrow().state == State::Running {
                job.cancel.store(true, Ordering::Relaxed);
            }
        }
        self.0.bell.notify_all();
        while desk.workers > 0 {
            desk = self.0.bell.wait(desk).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn desk(&self) -> MutexGuard<'_, Desk> {
        self.0.desk()
    }
}

impl Office {
    fn desk(&self) -> MutexGuard<'_, Desk> {
        self.desk.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next job to run; none when the service stops.
    fn next(&self) -> Option<Arc<Job>> {
        let mut desk = self.desk();
        loop {
            if desk.stopping {
                return None;
            }
            if let Some(job) = desk.queue.pop_front() {
                job.status.send_modify(Status::start);
                return Some(job);
            }
            desk = self.bell.wait(desk).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Ends a job: its record and its texts are kept, then everybody is told.
    fn finish(
        &self,
        job: &Job,
        state: State,
        tell: impl FnOnce(&mut Status),
        texts: &[(String, String)],
    ) {
        let mut status = job.status();
        status.finish(state);
        tell(&mut status);
        let bytes = texts.iter().map(|(_, text)| text.len() as u64).sum();
        job.bytes.fetch_add(bytes, Ordering::Relaxed);
        self.desk().stored += bytes;
        let record = job.record(status.clone());
        if let Err(error) = self.store.finish_job(&job.id, &record, texts) {
            tracing::error!(id = job.id, %error, "the end of a job cannot be kept");
            status.lost(&error.to_string());
        }
        *job.live.lock().unwrap_or_else(PoisonError::into_inner) = MeasuredSink::default();
        job.status.send_replace(status);
    }

    /// Notes that a job is over, and forgets the oldest of too many.
    fn over(&self, job: &Job) {
        if !job.status.borrow().state.is_over() {
            return;
        }
        let forgotten = self.desk().retire(&self.limits, &job.id);
        for id in forgotten {
            if let Err(error) = self.store.remove_job(&id) {
                tracing::warn!(id, %error, "an old job cannot be forgotten");
            }
        }
    }
}
