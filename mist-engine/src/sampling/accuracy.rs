//! The accuracy of an adaptive integral.

/// Largest error of an integral, its limit of evaluations, and what happens at the limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Largest error of an element, relative to the largest element: that of unpolarized light.
    pub tolerance: f64,
    /// Evaluations of the model, at most; they are held in memory, about 6 bytes each.
    pub budget: u64,
    /// True if an integral that does not reach the tolerance has no value. Otherwise its value stands
    /// with the error that was reached.
    pub is_required: bool,
}

impl Accuracy {
    /// Accuracy of integrals without settings: a tolerance of 1e-5, and 10⁶ evaluations.
    pub const DEFAULT: Self = Self { tolerance: 1e-5, budget: 1_000_000, is_required: false };

    /// An accuracy without which there is no value.
    pub const fn required(tolerance: f64, budget: u64) -> Self {
        Self { tolerance, budget, is_required: true }
    }
}
