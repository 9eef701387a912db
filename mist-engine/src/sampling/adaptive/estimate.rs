//! A Mueller integral with its estimated error.

use scattering::Mueller;

/// Errors below this are small enough whatever the integral is: without it, integrals that
/// vanish up to rounding would never be done.
pub const FLOOR: f64 = 1e-20;

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
    /// The largest error of an element, relative to the largest element; 0 for errors that are
    /// rounding whatever the integral is.
    pub fn relative_error(&self) -> f64 {
        let error = self.error.largest();
        if error <= FLOOR { 0.0 } else { error / self.matrix.largest() }
    }

    pub(super) fn is_finite(&self) -> bool {
        let finite = |m: &Mueller| m.0.iter().flatten().all(|x| x.is_finite());
        finite(&self.matrix) && finite(&self.error)
    }
}
