//! The state that handlers share.

use std::{
    path::Path,
    sync::{Arc, atomic::AtomicBool},
};

use axum::body::Bytes;
use mist_engine::Control;

use super::{
    client::Client, error::ApiError, failed_keys::FailedKeys, origin::OriginRules,
    prepared_lobes::PreparedLobesCache, problem::Problem,
};
use crate::{
    access::AccessOptions,
    compute::{ComputeError, ComputeLimits, ComputePool, WorkRequest, WorkSize},
    jobs::Jobs,
    keys::Keys,
    limits::{LimitReached, ServeLimits},
    materials::{Materials, StoredMaterial},
    memory::MemoryBudget,
    metrics::Metrics,
    single_flight::{Producer, SingleFlight},
    store::{Store, StoreError},
};

/// Files of materials that are computed or kept.
pub(super) type FileFlights = SingleFlight<Bytes, Problem>;
/// The side that computes a file.
pub(super) type FileProducer = Producer<Bytes, Problem>;

/// The state that handlers share; clones share it.
#[derive(Clone)]
pub struct App {
    pub(super) limits: Arc<ServeLimits>,
    /// The limits of keys with the scope `read`.
    pub(super) read_limits: Arc<ServeLimits>,
    pub(super) access: Arc<AccessOptions>,
    pub(super) origins: Arc<OriginRules>,
    pub(super) keys: Option<Arc<Keys>>,
    pub(super) failed_keys: FailedKeys,
    pub(super) compute: ComputePool,
    pub(super) memory: MemoryBudget,
    pub(super) materials: Materials,
    pub(super) lobes: PreparedLobesCache,
    pub(super) files: FileFlights,
    pub(super) metrics: Metrics,
    pub(super) jobs: Jobs,
    store: Store,
}

/// The reason why the service cannot start.
#[derive(Debug, thiserror::Error)]
pub enum StartError {
    /// The store cannot be read.
    #[error("{0}")]
    Store(String),
    /// The file of keys is wrong.
    #[error("{0}")]
    Keys(String),
}

impl From<StoreError> for StartError {
    fn from(error: StoreError) -> Self {
        Self::Store(error.to_string())
    }
}

impl Default for App {
    /// Without limits of its own and without keys; its store is in memory.
    fn default() -> Self {
        Self::new(ServeLimits::default(), None, None).expect("memory can be read and written")
    }
}

impl App {
    /// With the store in the folder `data`, or in memory; `keys` is the text of a file of keys.
    ///
    /// # Errors
    ///
    /// If the store cannot be read, or the keys are wrong.
    pub fn new(
        limits: ServeLimits,
        data: Option<&Path>,
        keys: Option<&str>,
    ) -> Result<Self, StartError> {
        let limits = Arc::new(limits);
        let store = Store::new(data)?;
        let materials = Materials::default();
        for (name, text, owner) in store.materials()? {
            let is_json = text.trim_start().starts_with('{');
            match StoredMaterial::new(text, is_json, owner, &limits) {
                Ok(material) => materials.insert(name, material),
                Err(error) => tracing::warn!(
                    name,
                    error = error.message(),
                    "a stored material cannot be used; it stays in the store: put it again, or \
                     delete it"
                ),
            }
        }
        let jobs = Jobs::open(store.clone(), limits.clone())?;
        jobs.start();
        Ok(Self {
            read_limits: Arc::new(limits.of_reader()),
            access: Arc::default(),
            origins: Arc::default(),
            failed_keys: FailedKeys::default(),
            keys: keys.map(Keys::parse).transpose().map_err(StartError::Keys)?.map(Arc::new),
            compute: ComputePool::new(ComputeLimits {
                running: limits.max_computing,
                client_running: limits.max_client_computing,
                waiting: limits.max_waiting,
                client_waiting: limits.max_client_waiting,
            }),
            memory: MemoryBudget::new(limits.max_memory),
            materials,
            lobes: PreparedLobesCache::default(),
            files: FileFlights::new(limits.max_kept),
            metrics: Metrics::default(),
            jobs,
            store,
            limits,
        })
    }

    /// The same with these rules about hosts, web pages and addresses.
    #[must_use]
    pub fn with_access(mut self, access: AccessOptions) -> Self {
        self.origins = Arc::new(OriginRules::new(&access));
        self.access = Arc::new(access);
        self
    }

    /// Ends the answers that last as long as a job, so that the service can stop.
    pub fn leave(&self) {
        self.jobs.leave();
    }

    /// Stops the jobs; their finished steps are stored. Returns when they have stopped.
    pub fn stop(&self) {
        self.jobs.stop();
    }

    /// Does `work` on the compute pool, within the time of one answer. It ends when the future
    /// is dropped, because its client has left.
    pub(super) async fn compute_in_time<T: Send + 'static>(
        &self,
        client: &Client,
        size: WorkSize,
        work: impl FnOnce(&Control) -> T + Send + 'static,
    ) -> Result<T, ApiError> {
        self.compute_until(client, size, Arc::default(), work).await
    }

    /// The same for work that ends too when `cancel` is set.
    pub(super) async fn compute_until<T: Send + 'static>(
        &self,
        client: &Client,
        size: WorkSize,
        cancel: Arc<AtomicBool>,
        work: impl FnOnce(&Control) -> T + Send + 'static,
    ) -> Result<T, ApiError> {
        let control = Control { cancel: cancel.clone(), progress: None };
        let time = client.limits.time();
        let request = WorkRequest { client: client.name.clone(), size, time, cancel };
        match self.compute.run(request, move || work(&control)).await {
            Ok(done) => Ok(done),
            Err(ComputeError::TooLong) => Err(client.too_long()),
            Err(ComputeError::ClientQueueFull) => Err(ApiError::TooMany(LimitReached {
                flag: "max-client-waiting",
                value: self.limits.max_client_waiting as f64,
                message: "too many answers for this client wait".into(),
            })),
            Err(ComputeError::QueueFull) => Err(ApiError::Busy(LimitReached {
                flag: "max-waiting",
                value: self.limits.max_waiting as f64,
                message: "too many answers wait".into(),
            })),
            Err(error @ (ComputeError::Cancelled | ComputeError::NoThreads)) => {
                Err(ApiError::Unavailable(error.to_string()))
            }
            Err(error @ ComputeError::Panicked) => Err(ApiError::Failed(error.to_string())),
        }
    }

    /// Reads or writes the store.
    pub(super) async fn store<T: Send + 'static>(
        &self,
        work: impl FnOnce(&Store) -> Result<T, StoreError> + Send + 'static,
    ) -> Result<T, ApiError> {
        self.blocking(move |app| Ok(work(&app.store)?)).await
    }

    /// Does `work` that waits for a disk.
    pub(super) async fn blocking<T: Send + 'static>(
        &self,
        work: impl FnOnce(&Self) -> Result<T, ApiError> + Send + 'static,
    ) -> Result<T, ApiError> {
        let app = self.clone();
        let done = tokio::task::spawn_blocking(move || work(&app)).await;
        done.map_err(|error| ApiError::Failed(error.to_string()))?
    }
}
