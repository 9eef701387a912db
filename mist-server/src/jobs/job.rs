//! One job and its record in the store.

use std::sync::{
    Arc, Mutex, PoisonError,
    atomic::{AtomicBool, AtomicU64, Ordering},
};

use serde::{Deserialize, Serialize};
use tokio::sync::watch;

use super::status::JobStatus;
use crate::output::BoundedOutput;

/// One job.
pub(crate) struct ServiceJob {
    /// Name in addresses.
    pub(crate) id: String,
    pub(super) number: u64,
    pub(super) client: String,
    /// Bytes of its program and of its texts.
    pub(super) bytes: AtomicU64,
    pub(super) cancel: Arc<AtomicBool>,
    pub(super) status: watch::Sender<JobStatus>,
    /// The texts so far, while it runs.
    pub(super) output: Mutex<BoundedOutput>,
}

/// The record of a job in the store.
#[derive(Deserialize, Serialize)]
pub(super) struct JobRecord {
    pub(super) number: u64,
    pub(super) client: String,
    #[serde(default)]
    pub(super) bytes: u64,
    pub(super) status: JobStatus,
}

impl ServiceJob {
    pub(super) fn new(record: JobRecord) -> Self {
        Self {
            id: record.status.id.clone(),
            number: record.number,
            client: record.client,
            bytes: AtomicU64::new(record.bytes),
            cancel: Arc::default(),
            status: watch::channel(record.status).0,
            output: Mutex::default(),
        }
    }

    /// The client that submitted it.
    pub(crate) fn client(&self) -> &str {
        &self.client
    }

    /// Its status now.
    pub(crate) fn status(&self) -> JobStatus {
        self.status.borrow().clone()
    }

    /// Its status and every change of it.
    pub(crate) fn watch(&self) -> watch::Receiver<JobStatus> {
        self.status.subscribe()
    }

    /// The results so far.
    pub(crate) fn results_so_far(&self) -> String {
        self.output.lock().unwrap_or_else(PoisonError::into_inner).results.clone()
    }

    /// Its record with `status`.
    pub(super) fn record(&self, status: JobStatus) -> String {
        let record = JobRecord {
            number: self.number,
            client: self.client.clone(),
            bytes: self.bytes.load(Ordering::Relaxed),
            status,
        };
        json(&record)
    }
}

/// The JSON of a record or a program.
pub(super) fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("texts and numbers have a JSON form")
}
