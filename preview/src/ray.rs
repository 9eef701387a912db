//! Rays and the points where they meet a surface.

use glam::DVec3;

/// Distance that a ray keeps from the point where it starts.
const CLEAR: f64 = 1e-6;

/// A half line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SceneRay {
    pub(crate) from: DVec3,
    /// Unit vector.
    pub(crate) along: DVec3,
}

/// A point of a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceHit {
    pub(crate) distance: f64,
    pub(crate) point: DVec3,
    /// Unit vector, away from the body, of the shading.
    pub(crate) normal: DVec3,
    /// The same of the true surface.
    pub(crate) true_normal: DVec3,
}

impl SurfaceHit {
    /// The ray that starts at this point in the direction `along`.
    pub(crate) fn leaving(&self, along: DVec3) -> SceneRay {
        SceneRay { from: self.point + CLEAR * self.true_normal, along }
    }
}
