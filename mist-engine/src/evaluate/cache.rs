//! A cache that forgets everything when it holds too much.

use std::hash::Hash;

use rustc_hash::FxHashMap;

/// A map with a fast hash; its order is never used.
pub(super) type FastMap<K, V> = FxHashMap<K, V>;

/// Values of a total weight up to a bound.
///
/// They lie in the order they came, so that few pages of memory are touched by many of them.
pub(super) struct WeightedCache<K, V> {
    places: FastMap<K, u32>,
    values: Vec<V>,
    weight: usize,
    most: usize,
}

impl<K: Hash + Eq, V: Clone> WeightedCache<K, V> {
    /// A cache for a total weight up to `most`.
    pub(super) fn up_to(most: usize) -> Self {
        Self { places: FastMap::default(), values: Vec::new(), weight: 0, most }
    }

    pub(super) fn get(&self, key: &K) -> Option<&V> {
        self.places.get(key).map(|place| &self.values[*place as usize])
    }

    pub(super) fn insert(&mut self, key: K, value: V, weight: usize) {
        if self.weight + weight > self.most || u32::try_from(self.values.len()).is_err() {
            self.places.clear();
            self.values.clear();
            self.weight = 0;
        }
        self.weight += weight;
        self.places.insert(key, self.values.len() as u32);
        self.values.push(value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_cache_starts_again_and_keeps_the_new_value() {
        let mut cache = WeightedCache::up_to(2);
        cache.insert(1, 'a', 1);
        cache.insert(2, 'b', 1);
        cache.insert(3, 'c', 1);
        assert_eq!((cache.get(&1), cache.get(&3)), (None, Some(&'c')));
    }
}
