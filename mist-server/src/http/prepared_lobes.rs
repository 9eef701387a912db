//! Materials at the wavelengths of a query, kept ready for single directions.

use std::{
    num::NonZeroUsize,
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
    time::{Duration, Instant},
};

use lru::LruCache;
use mist_engine::material::lobes::{LobeOutput, Lobes};

/// Number of queries that are kept ready.
const CAPACITY: NonZeroUsize = NonZeroUsize::new(64).expect("64 is not 0");

/// A material at the wavelengths of a query, and the quantities that the query asks for.
pub(super) struct PreparedLobes {
    pub(super) lobes: Lobes,
    pub(super) out: LobeOutput,
    /// Nanoseconds of an evaluation in the slowest answer so far; 0 before the first.
    nanoseconds: AtomicU64,
}

impl PreparedLobes {
    pub(super) fn new(lobes: Lobes, out: LobeOutput) -> Self {
        Self { lobes, out, nanoseconds: AtomicU64::new(0) }
    }

    /// Estimated time of this number of evaluations, from earlier computations.
    pub(super) fn expected_time(&self, evaluations: usize) -> Duration {
        match self.nanoseconds.load(Ordering::Relaxed) {
            0 => Duration::MAX,
            each => Duration::from_nanos(each.saturating_mul(evaluations as u64)),
        }
    }

    /// Does `work`, so many evaluations, and remembers the time that it took.
    pub(super) fn measured<T>(&self, evaluations: usize, work: impl FnOnce(&Lobes) -> T) -> T {
        let begun = Instant::now();
        let done = work(&self.lobes);
        let each = begun.elapsed().as_nanos() / evaluations.max(1) as u128;
        let each = u64::try_from(each).unwrap_or(u64::MAX).max(1);
        self.nanoseconds.fetch_max(each, Ordering::Relaxed);
        done
    }
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
