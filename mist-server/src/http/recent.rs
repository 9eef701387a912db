//! The things that were used last, by name.

use std::{
    collections::HashMap,
    sync::{Arc, Mutex, PoisonError},
};

/// Keeps a bounded number of things, those that were used last.
pub(super) struct Recent<T> {
    most: usize,
    shelf: Arc<Mutex<Shelf<T>>>,
}

struct Shelf<T> {
    clock: u64,
    things: HashMap<String, (u64, Arc<T>)>,
}

impl<T> Clone for Recent<T> {
    fn clone(&self) -> Self {
        Self { most: self.most, shelf: self.shelf.clone() }
    }
}

impl<T> Recent<T> {
    /// Room for `most` things.
    pub(super) fn new(most: usize) -> Self {
        let shelf = Shelf { clock: 0, things: HashMap::new() };
        Self { most, shelf: Arc::new(Mutex::new(shelf)) }
    }

    /// What is kept under `key`.
    pub(super) fn get(&self, key: &str) -> Option<Arc<T>> {
        let mut shelf = self.shelf.lock().unwrap_or_else(PoisonError::into_inner);
        shelf.clock += 1;
        let clock = shelf.clock;
        let (used, thing) = shelf.things.get_mut(key)?;
        *used = clock;
        Some(thing.clone())
    }

    /// Keeps `thing`; gives what was kept under `key` meanwhile, if there is such a thing.
    pub(super) fn keep(&self, key: String, thing: Arc<T>) -> Arc<T> {
        let mut shelf = self.shelf.lock().unwrap_or_else(PoisonError::into_inner);
        shelf.clock += 1;
        let clock = shelf.clock;
        let kept = shelf.things.entry(key).or_insert((clock, thing)).1.clone();
        while shelf.things.len() > self.most {
            // The order of the map does not matter: no two things were used at the same time.
            let oldest = shelf.things.iter().min_by_key(|(_, (used, _))| *used);
            let Some(oldest) = oldest.map(|(key, _)| key.clone()) else { break };
            shelf.things.remove(&oldest);
        }
        kept
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_used_longest_ago_goes_first() {
        let recent = Recent::new(2);
        recent.keep("a".into(), Arc::new(1));
        recent.keep("b".into(), Arc::new(2));
        assert_eq!(recent.get("a").as_deref(), Some(&1));
        recent.keep("c".into(), Arc::new(3));
        assert_eq!((recent.get("a").is_some(), recent.get("b").is_some()), (true, false));
        assert_eq!(*recent.keep("a".into(), Arc::new(9)), 1);
    }
}
