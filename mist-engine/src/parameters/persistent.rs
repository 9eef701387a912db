//! Immutable parts of the parameters that several states share.

use std::{
    hash::{Hash, Hasher},
    ops::Deref,
    sync::{Arc, OnceLock},
};

use rustc_hash::FxHasher;

/// A value with cheap clones that is copied when it is changed, and its hash, computed once.
#[derive(Clone, Debug, Default)]
pub(crate) struct Persistent<T>(Arc<Inner<T>>);

#[derive(Clone, Debug, Default)]
struct Inner<T> {
    value: T,
    hash: OnceLock<u64>,
}

impl<T: Clone + Hash> Persistent<T> {
    pub(crate) fn new(value: T) -> Self {
        Self(Arc::new(Inner { value, hash: OnceLock::new() }))
    }

    /// The value for a change; clones of `self` keep the old one.
    pub(crate) fn edit(&mut self) -> &mut T {
        let inner = Arc::make_mut(&mut self.0);
        inner.hash = OnceLock::new();
        &mut inner.value
    }

    /// The hash of the value: equal values have equal hashes.
    pub(crate) fn hash_code(&self) -> u64 {
        *self.0.hash.get_or_init(|| {
            let mut hasher = FxHasher::default();
            self.0.value.hash(&mut hasher);
            hasher.finish()
        })
    }

    /// True if both share their memory.
    pub(crate) fn is_same_as(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl<T> Deref for Persistent<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.0.value
    }
}

impl<T: Clone + Hash> Hash for Persistent<T> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        state.write_u64(self.hash_code());
    }
}

impl<T: Clone + Hash + Eq> PartialEq for Persistent<T> {
    fn eq(&self, other: &Self) -> bool {
        self.is_same_as(other)
            || (self.hash_code() == other.hash_code() && self.0.value == other.0.value)
    }
}

impl<T: Clone + Hash + Eq> Eq for Persistent<T> {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_leaves_clones_alone_and_renews_the_hash() {
        let first = Persistent::new("a".to_owned());
        let mut second = first.clone();
        assert_eq!(first, second);
        second.edit().push('b');
        assert_ne!((&first, first.hash_code()), (&second, second.hash_code()));
        assert_eq!((first.as_str(), second.as_str()), ("a", "ab"));
        second.edit().pop();
        assert_eq!((&first, first.hash_code()), (&second, second.hash_code()));
    }
}
