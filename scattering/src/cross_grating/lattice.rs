//! The periods of a crossed grating and their angle.

use crate::{ParameterError, ParameterNode};

/// The periods of a crossed grating.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Period along axis 1, µm.
    pub d1: f64,
    /// Period along axis 2, µm.
    pub d2: f64,
    /// Angle from y to axis 2, radians.
    pub zeta: f64,
}

impl Lattice {
    /// Lateral wave vector, in units of 2π/`lambda`, of the order (i, j).
    pub fn harmonic(&self, i: isize, j: isize, lambda: f64) -> (f64, f64) {
        let (a, b) = (i as f64 * lambda / self.d1, j as f64 * lambda / self.d2);
        (a, (b - a * self.zeta.sin()) / self.zeta.cos())
    }
}

/// The angle `name` in degrees, if two axes can enclose it.
pub(crate) fn lean(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let angle = node.number(name);
    if angle.abs() < 90.0 {
        return Ok(angle.to_radians());
    }
    Err(ParameterError::new(name, format!("{angle} is not between -90 and 90")))
}
