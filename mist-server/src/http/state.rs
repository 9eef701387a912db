//! What handlers share.

use std::{path::Path, sync::Arc};

use super::{
    error::ApiError,
    evaluate::Ready,
    file::too_long,
    flight::Flights,
    materials::{Kept, Materials},
    metrics::Metrics,
    recent::Recent,
};
use crate::{
    compute::Compute,
    jobs::Jobs,
    memory::Memory,
    store::{Store, StoreError},
};
use crate::{keys::Keys, limits::ServeLimits};

/// Materials at the wavelengths of a query that are kept ready.
const READY: usize = 64;

/// What handlers share; clones are the same.
#[derive(Clone)]
pub struct App {
    pub(super) limits: Arc<ServeLimits>,
    pub(super) keys: Option<Arc<Keys>>,
    pub(super) compute: Compute,
    pub(super) memory: Memory,
    pub(super) materials: Materials,
    pub(super) ready: Recent<Ready>,
    pub(super) flights: Flights,
    pub(super) metrics: Metrics,
    pub(super) jobs: Jobs,
    store: Store,
}

/// Why the service cannot start.
#[derive(Debug, thiserror::Error)]
pub enum StartError {
    /// What it kept cannot be read.
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
    /// Without limits of its own and without keys; what it keeps is gone with it.
    fn default() -> Self {
        Self::new(ServeLimits::default(), None, None).expect("memory can be read and written")
    }
}

impl App {
    /// With what is kept in the folder `data`, or nothing; `keys` is the text of a file of keys.
    ///
    /// # Errors
    ///
    /// If what is kept cannot be read, or there is something wrong with the keys.
    pub fn new(
        limits: ServeLimits,
        data: Option<&Path>,
        keys: Option<&str>,
    ) -> Result<Self, StartError> {
        let limits = Arc::new(limits);
        let store = Store::new(data)?;
        let materials = Materials::default();
        for (name, text) in store.materials()? {
            match Kept::new(text, &limits) {
                Ok(kept) => materials.keep(name, kept),
                Err(error) => {
                    let error = error.problem().message;
                    tracing::warn!(name, error, "a material cannot be prepared any more");
                }
            }
        }
        let jobs = Jobs::open(store.clone(), limits.clone())?;
        jobs.start();
        Ok(Self {
            keys: keys.map(Keys::parse).transpose().map_err(StartError::Keys)?.map(Arc::new),
            compute: Compute::new(limits.max_computing, limits.max_waiting),
            memory: Memory::new(limits.max_memory),
            materials,
            ready: Recent::new(READY),
            flights: Flights::new(limits.max_kept),
            metrics: Metrics::default(),
            jobs,
            store,
            limits,
        })
    }

    /// Ends the answers that go on as long as a job: they would keep a service that stops.
    pub fn leave(&self) {
        self.jobs.leave();
    }

    /// Stops the jobs; what they finished is kept. Returns when they have stopped.
    pub fn stop(&self) {
        self.jobs.stop();
    }

    /// Does `work` where it does not keep others waiting, within the time of one answer.
    pub(super) async fn compute_in_time<T: Send + 'static>(
        &self,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T, ApiError> {
        match tokio::time::timeout(self.limits.time(), self.compute.run(work)).await {
            Ok(done) => Ok(done?),
            Err(_) => Err(too_long(self)),
        }
    }

    /// Reads or writes what is kept.
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
