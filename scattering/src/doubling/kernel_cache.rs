//! Computed operators by content: the last ones of the process, shared by all models.
//!
//! The key consists of all numbers that a value depends on. Threads that ask for the same new value at
//! the same time compute it independently of each other: nothing waits under a lock.

use std::{
    collections::VecDeque,
    sync::{Arc, Mutex, PoisonError},
};

/// All numbers that a value depends on, as bits.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ContentKey(Vec<u64>);

impl ContentKey {
    /// Adds `numbers` and how many they are.
    pub fn extend(&mut self, numbers: impl ExactSizeIterator<Item = f64>) {
        self.0.push(numbers.len() as u64);
        self.0.extend(numbers.map(f64::to_bits));
    }
}

/// Values by content up to a total size; the newest one is cached whatever its size.
#[derive(Debug)]
pub struct KernelCache<V> {
    /// Values with their size, bytes, in the order of their last use.
    kernels: Mutex<VecDeque<(ContentKey, usize, Arc<V>)>>,
    /// The largest size of all values together, bytes.
    most_bytes: usize,
}

impl<V> KernelCache<V> {
    /// An empty cache of at most `most_bytes` bytes.
    pub const fn new(most_bytes: usize) -> Self {
        Self { kernels: Mutex::new(VecDeque::new()), most_bytes }
    }

    /// The value under `key`; `compute` returns it with its size in bytes if it is not cached.
    pub fn get_or_compute(&self, key: ContentKey, compute: impl FnOnce() -> (V, usize)) -> Arc<V> {
        if let Some(known) = self.get(&key) {
            return known;
        }
        let (value, bytes) = compute();
        let value = Arc::new(value);
        self.insert(key, bytes, value.clone());
        value
    }

    fn get(&self, key: &ContentKey) -> Option<Arc<V>> {
        // A panic while the list was locked leaves a usable list.
        let mut kernels = self.kernels.lock().unwrap_or_else(PoisonError::into_inner);
        let at = kernels.iter().position(|(known, ..)| known == key)?;
        let found = kernels.remove(at)?;
        let value = found.2.clone();
        kernels.push_back(found);
        Some(value)
    }

    fn insert(&self, key: ContentKey, bytes: usize, value: Arc<V>) {
        let mut kernels = self.kernels.lock().unwrap_or_else(PoisonError::into_inner);
        if kernels.iter().any(|(known, ..)| *known == key) {
            return;
        }
        kernels.push_back((key, bytes, value));
        let mut total: usize = kernels.iter().map(|(_, bytes, _)| bytes).sum();
        while total > self.most_bytes && kernels.len() > 1 {
            total -= kernels.pop_front().map_or(0, |(_, bytes, _)| bytes);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(numbers: &[f64]) -> ContentKey {
        let mut key = ContentKey::default();
        key.extend(numbers.iter().copied());
        key
    }

    #[test]
    fn the_value_that_was_not_used_longest_leaves_first() {
        let cache = KernelCache::new(2);
        let ask = |number: f64| {
            let mut computed = false;
            let value = cache.get_or_compute(key(&[number]), || {
                computed = true;
                (number, 1)
            });
            assert_eq!(*value, number);
            computed
        };
        assert!(ask(0.1) && ask(0.2) && !ask(0.1) && ask(0.3));
        assert!(!ask(0.1) && !ask(0.3) && ask(0.2));
    }

    #[test]
    fn a_value_that_is_larger_than_the_cache_is_cached_alone() {
        let cache = KernelCache::new(2);
        for (number, expected) in [(1.0, 7.0), (1.0, 7.0), (2.0, 8.0)] {
            let value = cache.get_or_compute(key(&[number]), || (number + 6.0, 9));
            assert_eq!(*value, expected);
        }
        assert_eq!(cache.kernels.lock().unwrap().len(), 1);
    }

    #[test]
    fn lists_of_other_lengths_have_other_keys() {
        let (mut a, mut b) = (key(&[1.0]), key(&[1.0, 2.0]));
        a.extend([2.0, 3.0].into_iter());
        b.extend([3.0].into_iter());
        assert_ne!(a, b);
    }
}
