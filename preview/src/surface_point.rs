//! Surface points that another renderer found, and the distant lamps that light them.

use glam::DVec3;

use crate::scene::LampBasis;

/// A surface point that the camera sees.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The column of the pixel that shows it.
    pub column: usize,
    /// The fraction of the pixel that it covers.
    pub part: f64,
    /// Unit vector away from the body.
    pub normal: DVec3,
    /// Unit vector to the camera.
    pub to_camera: DVec3,
    /// Unit vector perpendicular to `to_camera` that points to the right of the picture.
    pub horizontal: DVec3,
    /// Irradiance of each lamp on a surface that faces it; 0 in its shadow.
    pub irradiances: Vec<f64>,
}

/// The lamps of [`shade`](fn@crate::shade).
#[derive(Clone, Copy, Debug)]
pub struct DistantLamps<'a> {
    /// Unit vectors to the lamps.
    pub toward: &'a [DVec3],
    /// Stokes vector of their light; its first component is 1.
    pub light: [f64; 4],
    /// The basis of that vector.
    pub light_basis: LampBasis,
}
