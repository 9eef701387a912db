//! Cells of grids in the polar angles.

use super::PolarAngles;

/// The directions between two polar angles and two azimuths, rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolarCell {
    /// Polar angles from 0 to π/2, rising.
    pub theta: (f64, f64),
    /// Azimuths, rising; their difference is at most 2π.
    pub phi: (f64, f64),
    /// The direction at which sensitivities are given; without one each direction has its own s and
    /// p.
    pub center: Option<PolarAngles>,
}

impl PolarCell {
    /// The projected solid angle, sr.
    pub fn projected_solid_angle(&self) -> f64 {
        let (low, high) = self.theta;
        0.5 * (self.phi.1 - self.phi.0) * (high.sin().powi(2) - low.sin().powi(2))
    }
}
