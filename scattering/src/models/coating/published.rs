//! The equations of the pigmented coating as the paper prints them.

use crate::{Direction, Incidence, Mueller};

/// Parts that are computed as the paper prints them.
pub(super) struct PublishedForm {
    pub(super) body: bool,
    pub(super) surface: bool,
    pub(super) flakes: bool,
}

/// The Mueller matrix of the transposed Jones matrix.
pub(super) fn transposed_jones(m: &Mueller) -> Mueller {
    let d = Mueller::diagonal([1.0, 1.0, 1.0, -1.0]);
    d * m.transposed() * d
}

/// (1 + ζ)²/(1 + ζ²)² of the facet that reflects one ray into the other.
pub(super) fn printed_jacobian(at: &Incidence, to: &Direction) -> f64 {
    let (x, y) = (to.sin * to.cos_phi - at.sin, to.sin * to.sin_phi);
    let slope = x.hypot(y) / (at.cos + to.cos);
    ((1.0 + slope) / (1.0 + slope * slope)).powi(2)
}
