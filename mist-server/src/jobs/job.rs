//! One job: where it stands and what is kept of it.

use std::sync::{
    Arc, Mutex, PoisonError,
    atomic::{AtomicBool, AtomicU64, Ordering},
};

use serde::{Deserialize, Serialize};
use tokio::sync::watch;

use super::{MeasuredSink, Status};

/// One job.
pub(crate) struct Job {
    /// Its name in addresses.
    pub(crate) id: String,
    pub(super) number: u64,
    pub(super) client: String,
    /// Bytes of its program and of its texts.
    pub(super) bytes: AtomicU64,
    pub(super) cancel: Arc<AtomicBool>,
    pub(super) status: watch::Sender<Status>,
    /// The texts as far as they are, while it runs.
    pub(super) live: Mutex<MeasuredSink>,
}

/// What is kept of a job.
#[derive(Deserialize, Serialize)]
pub(super) struct Record {
    pub(super) number: u64,
    pub(super) client: String,
    #[serde(default)]
    pub(super) bytes: u64,
    pub(super) status: Status,
}

impl Job {
    pub(super) fn new(record: Record) -> Self {
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
    pub(super) fn record(&self, status: Status) -> String {
        let record = Record {
            number: self.number,
            client: self.client.clone(),
            bytes: self.bytes.load(Ordering::Relaxed),
            status,
        };
        json(&record)
    }
}

pub(super) fn json(what: &impl Serialize) -> String {
    serde_json::to_string(what).expect("texts and numbers have a JSON form")
}
