//! A cache that forgets everything when it holds too much.

use std::{
    collections::HashMap,
    hash::{BuildHasherDefault, Hash},
};

use crate::parameters::Digest;

/// A map with a fast hash; its order is never used.
pub(crate) type Map<K, V> = HashMap<K, V, BuildHasherDefault<Digest>>;

/// Values of a total weight up to a bound.
pub(crate) struct Kept<K, V> {
    map: Map<K, V>,
    weight: usize,
    most: usize,
}

impl<K: Hash + Eq, V: Clone> Kept<K, V> {
    /// A cache for a total weight up to `most`.
    pub(crate) fn up_to(most: usize) -> Self {
        Self { map: Map::default(), weight: 0, most }
    }

    pub(crate) fn get(&self, key: &K) -> Option<&V> {
        self.map.get(key)
    }

    pub(crate) fn insert(&mut self, key: K, value: V, weight: usize) {
        if self.weight + weight > self.most {
            self.map.clear();
            self.weight = 0;
        }
        self.weight += weight;
        self.map.insert(key, value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_cache_starts_again_and_keeps_the_new_value() {
        let mut kept = Kept::up_to(2);
        kept.insert(1, 'a', 1);
        kept.insert(2, 'b', 1);
        kept.insert(3, 'c', 1);
        assert_eq!((kept.get(&1), kept.get(&3)), (None, Some(&'c')));
    }
}
