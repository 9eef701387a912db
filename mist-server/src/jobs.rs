//! Programs that run in the background and outlive the service.
//!
//! A job is kept from the moment it is accepted; its finished steps are kept while it runs, its
//! texts when it is over. A service that starts takes up the jobs that were not over, in the
//! order in which they came.

mod ledger;
mod run;
mod sink;
mod status;

pub(crate) use sink::MeasuredSink;
pub(crate) use status::{State, Status};

use std::{
    collections::{BTreeMap, VecDeque},
    sync::{
        Arc, Condvar, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, AtomicU64, Ordering},
    },
};

use serde::{Deserialize, Serialize};
use tokio::sync::watch;

use crate::{
    http::{ApiError, Limit, ProgramBody},
    keys::hexadecimal,
    limits::ServeLimits,
    store::{Store, StoreError},
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
}

#[derive(Default)]
struct Desk {
    jobs: BTreeMap<String, Arc<Job>>,
    queue: VecDeque<Arc<Job>>,
    /// Jobs that are over, the oldest first.
    over: VecDeque<String>,
    /// Bytes of the programs and texts of all jobs.
    stored: u64,
    next: u64,
    stopping: bool,
    workers: usize,
}

/// One job.
pub(crate) struct Job {
    /// Its name in addresses.
    pub(crate) id: String,
    number: u64,
    client: String,
    /// Bytes of its program and of its texts.
    bytes: AtomicU64,
    cancel: Arc<AtomicBool>,
    status: watch::Sender<Status>,
    /// The texts as far as they are, while it runs.
    live: Mutex<MeasuredSink>,
}

/// What is kept of a job.
#[derive(Deserialize, Serialize)]
struct Record {
    number: u64,
    client: String,
    #[serde(default)]
    bytes: u64,
    status: Status,
}

impl Job {
    fn new(record: Record) -> Self {
        Self {
            id: record.status.id.clone(),
            number: record.number,
            client: record.client,
            bytes: AtomicU64::new(record.bytes),
            cancel: Arc::default(),
            status: watch::channel(record.status).0,
            live: Mutex::default(),
        }
    }

    /// Where it stands.
    pub(crate) fn status(&self) -> Status {
        self.status.borrow().clone()
    }

    /// Where it stands, and every change.
    pub(crate) fn watch(&self) -> watch::Receiver<Status> {
        self.status.subscribe()
    }

    /// The results as far as they are.
    pub(crate) fn results_so_far(&self) -> String {
        self.live.lock().unwrap_or_else(PoisonError::into_inner).results.clone()
    }

    /// What is kept of it when it stands at `status`.
    fn record(&self, status: Status) -> String {
        let record = Record {
            number: self.number,
            client: self.client.clone(),
            bytes: self.bytes.load(Ordering::Relaxed),
            status,
        };
        json(&record)
    }
}

fn json(what: &impl Serialize) -> String {
    serde_json::to_string(what).expect("texts and numbers have a JSON form")
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
        for mut record in records {
            desk.next = record.number + 1;
            desk.stored += record.bytes;
            let over = record.status.state.is_over();
            if !over {
                record.status.state = State::Queued;
            }
            let job = Arc::new(Job::new(record));
            desk.jobs.insert(job.id.clone(), job.clone());
            if over {
                desk.over.push_back(job.id.clone());
            } else {
                desk.queue.push_back(job);
            }
        }
        let desk = Mutex::new(desk);
        Ok(Self(Arc::new(Office { store, limits, desk, bell: Condvar::new() })))
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
            self.admit_to(&desk, &client)?;
            let status = Status::new(hexadecimal(&id), body.job.clone());
            let record = Record { number: desk.next, client, bytes, status };
            desk.next += 1;
            desk.stored += bytes;
            let job = Arc::new(Job::new(record));
            // It counts from now on, but waits until it is kept.
            desk.jobs.insert(job.id.clone(), job.clone());
            job
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
        self.admit_to(&self.desk(), client)
    }

    fn admit_to(&self, desk: &Desk, client: &str) -> Result<(), ApiError> {
        if desk.stopping {
            return Err(ApiError::Unavailable("the service is stopping".into()));
        }
        let limits = &self.0.limits;
        if desk.queue.len() >= limits.max_queued {
            let message = "too many jobs wait".into();
            let value = limits.max_queued as f64;
            return Err(ApiError::TooMany(Limit { flag: "max-queued", value, message }));
        }
        if desk.over.is_empty() && desk.stored >= limits.max_stored {
            let message = "the jobs that wait or run fill the store".into();
            let value = limits.max_stored as f64;
            return Err(ApiError::TooMany(Limit { flag: "max-stored", value, message }));
        }
        let open = desk.jobs.values().filter(|job| !job.status.borrow().state.is_over());
        if open.filter(|job| job.client == client).count() >= limits.max_client_jobs {
            let message = "this client has too many jobs that wait or run".into();
            let value = limits.max_client_jobs as f64;
            return Err(ApiError::TooMany(Limit { flag: "max-client-jobs", value, message }));
        }
        Ok(())
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
            let mut desk = self.desk();
            desk.remove(&job.id);
            desk.over.retain(|id| *id != job.id);
            return Ok(job.status());
        }
        job.cancel.store(true, Ordering::Relaxed);
        let waited = {
            let mut desk = self.desk();
            let before = desk.queue.len();
            desk.queue.retain(|other| other.id != job.id);
            desk.queue.len() < before
        };
        if waited {
            self.0.finish(job, State::Cancelled, |_| (), &[]);
            self.0.over(job);
        }
        Ok(job.status())
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
        texts: &[(&str, String)],
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
        let mut forgotten = Vec::new();
        let mut desk = self.desk();
        desk.over.push_back(job.id.clone());
        let limits = &self.limits;
        while desk.over.len() > limits.max_finished
            || (desk.stored > limits.max_stored && desk.over.len() > 1)
        {
            let Some(id) = desk.over.pop_front() else { break };
            desk.remove(&id);
            forgotten.push(id);
        }
        drop(desk);
        for id in forgotten {
            if let Err(error) = self.store.remove_job(&id) {
                tracing::warn!(id, %error, "an old job cannot be forgotten");
            }
        }
    }
}

impl Desk {
    /// Forgets a job and what it occupies.
    fn remove(&mut self, id: &str) {
        if let Some(job) = self.jobs.remove(id) {
            self.stored -= job.bytes.load(Ordering::Relaxed);
        }
    }
}
