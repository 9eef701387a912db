//! A Mueller integral with its estimated error.

use scattering::Mueller;

/// A Mueller integral and how far from the truth it may be.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The integral.
    pub matrix: Mueller,
    /// The estimated error of each element, not negative.
    pub error: Mueller,
    /// Evaluations of the model.
    pub evaluations: u64,
}

impl Estimate {
    pub(super) fn is_finite(&self) -> bool {
        let finite = |m: &Mueller| m.0.iter().flatten().all(|x| x.is_finite());
        finite(&self.matrix) && finite(&self.error)
    }
}
