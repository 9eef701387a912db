//! The family of densities of a diameter: its interface, and what its classes share.

use crate::spec::{self, Family, ParameterError, ParameterNode};

/// The family of densities of a diameter.
pub static FAMILY: Family =
    Family::new("Distribution", "Distributions of a diameter", spec::classes::<dyn Distribution>);

/// A probability density of a diameter.
pub trait Distribution: Send + Sync {
    /// Density in 1/µm at the diameter `d` µm.
    fn density(&self, d: f64) -> f64;
}

/// The number `name`, which has to be positive and finite.
pub(super) fn positive(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let x = node.number(name);
    if x > 0.0 && x.is_finite() {
        return Ok(x);
    }
    Err(ParameterError::new(name, format!("{x} is not positive")))
}
