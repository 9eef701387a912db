//! A number that tells states of parameters apart.

use std::hash::{DefaultHasher, Hash, Hasher};

/// A 128-bit digest of everything that a model is built from.
///
/// Two states with equal digests are taken for equal: among 10⁹ states of a run the chance of
/// a mistake is below 10⁻²⁰.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Fingerprint(u64, u64);

impl Fingerprint {
    /// The digest of `value`.
    pub(crate) fn of(value: &impl Hash) -> Self {
        let digest = |salt: u64| {
            let mut hasher = DefaultHasher::new();
            salt.hash(&mut hasher);
            value.hash(&mut hasher);
            hasher.finish()
        };
        Self(digest(0), digest(1))
    }
}
