//! Directions as polar angles and as unit vectors.

use glam::DVec3;

/// A direction (θ, φ) in radians.
pub type PolarAngles = (f64, f64);

/// The unit vector of a direction.
pub(crate) fn unit((theta, phi): PolarAngles) -> DVec3 {
    let ((s, c), (sp, cp)) = (theta.sin_cos(), phi.sin_cos());
    DVec3::new(s * cp, s * sp, c)
}
