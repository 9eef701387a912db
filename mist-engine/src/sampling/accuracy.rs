//! The accuracy that a program requires of an adaptive integral.

/// Required accuracy of an integral, and its limit of evaluations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Largest error of an element, relative to the largest element: that of unpolarized light.
    pub tolerance: f64,
    /// Evaluations of the model, at most; they are held in memory, about 6 bytes each.
    pub budget: u64,
}
