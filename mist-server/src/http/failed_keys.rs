//! Addresses that guess keys, and the delay of their answers.

use std::{
    num::NonZeroUsize,
    sync::{Arc, Mutex, PoisonError},
    time::{Duration, Instant},
};

use lru::LruCache;

/// Addresses that sent no key or a wrong one, and when they did so last; clones share them.
#[derive(Clone, Debug)]
pub(super) struct FailedKeys(Arc<Mutex<LruCache<String, (u32, Instant)>>>);

/// Number of addresses that are remembered.
const REMEMBERED: NonZeroUsize = NonZeroUsize::new(4096).expect("4096 is not 0");
/// Delay of the second refusal in a row; it grows by as much with each.
const STEP: Duration = Duration::from_millis(100);
/// The delay grows to so many steps.
const MOST_STEPS: u32 = 20;
/// An address without failures for so long starts anew.
const FORGOTTEN: Duration = Duration::from_secs(60);

impl Default for FailedKeys {
    fn default() -> Self {
        Self(Arc::new(Mutex::new(LruCache::new(REMEMBERED))))
    }
}

impl FailedKeys {
    /// Counts a failure of `address`; the time for which its answer is held back.
    pub(super) fn count(&self, address: &str) -> Duration {
        let mut failures = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let entry = failures.get_or_insert_mut(address.to_owned(), || (0, Instant::now()));
        if entry.1.elapsed() > FORGOTTEN {
            entry.0 = 0;
        }
        *entry = (entry.0 + 1, Instant::now());
        STEP * (entry.0 - 1).min(MOST_STEPS)
    }
}
