//! A part of the parameters that states of them share.

use std::{
    hash::{Hash, Hasher},
    ops::Deref,
    sync::{Arc, OnceLock},
};

use super::Fingerprint;

/// A value of which clones are cheap, and its digest once somebody wanted it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Persistent<T>(Arc<Inner<T>>);

#[derive(Clone, Debug, Default)]
struct Inner<T> {
    value: T,
    digest: OnceLock<Fingerprint>,
}

impl<T: Clone + Hash> Persistent<T> {
    pub(crate) fn new(value: T) -> Self {
        Self(Arc::new(Inner { value, digest: OnceLock::new() }))
    }

    /// The value to be changed; what others share stays.
    pub(crate) fn edit(&mut self) -> &mut T {
        let inner = Arc::make_mut(&mut self.0);
        inner.digest = OnceLock::new();
        &mut inner.value
    }

    pub(crate) fn digest(&self) -> Fingerprint {
        *self.0.digest.get_or_init(|| Fingerprint::of(&self.0.value))
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
        self.digest().hash(state);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_changed_value_has_another_digest_and_leaves_its_clones_alone() {
        let first = Persistent::new("a".to_owned());
        let mut second = first.clone();
        assert_eq!(first.digest(), second.digest());
        second.edit().push('b');
        assert_ne!(first.digest(), second.digest());
        assert_eq!((first.as_str(), second.as_str()), ("a", "ab"));
        second.edit().pop();
        assert_eq!(first.digest(), second.digest());
    }
}
