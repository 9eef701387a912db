//! Materials at the wavelengths of a query, kept ready for single directions.

use std::{
    num::NonZeroUsize,
    sync::{Arc, Mutex, PoisonError},
};

use lru::LruCache;
use mist_engine::material::lobes::{LobeOutput, Lobes};

/// Number of queries that are kept ready.
const CAPACITY: NonZeroUsize = NonZeroUsize::new(64).expect("64 is not 0");

/// A material at the wavelengths of a query, and the quantities that the query asks for.
pub(super) struct PreparedLobes {
    pub(super) lobes: Lobes,
    pub(super) out: LobeOutput,
}

/// The least recently used queries make room; clones share the cache.
#[derive(Clone)]
pub(super) struct PreparedLobesCache(Arc<Mutex<LruCache<String, Arc<PreparedLobes>>>>);

impl Default for PreparedLobesCache {
    fn default() -> Self {
        Self(Arc::new(Mutex::new(LruCache::new(CAPACITY))))
    }
}

impl PreparedLobesCache {
    /// The lobes of the query `key`.
    pub(super) fn get(&self, key: &str) -> Option<Arc<PreparedLobes>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get(key).cloned()
    }

    /// Keeps `prepared`, or gives the lobes that another request has kept meanwhile.
    pub(super) fn insert(&self, key: String, prepared: PreparedLobes) -> Arc<PreparedLobes> {
        let mut cache = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        cache.get_or_insert(key, || Arc::new(prepared)).clone()
    }
}
