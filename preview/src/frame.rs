//! The local frame of a surface point: x is the fiducial axis (horizontal), z the normal.

use std::f64::consts::TAU;

use glam::DVec3;

/// The axes of a surface point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceFrame {
    x: DVec3,
    y: DVec3,
    pub(crate) normal: DVec3,
}

impl SurfaceFrame {
    /// The frame around a unit vector.
    pub(crate) fn of(normal: DVec3) -> Self {
        let x = DVec3::Y.cross(normal).try_normalize().unwrap_or(DVec3::X);
        Self { x, y: normal.cross(x), normal }
    }

    /// A vector in the axes of the frame.
    pub(crate) fn local(&self, v: DVec3) -> DVec3 {
        DVec3::new(v.dot(self.x), v.dot(self.y), v.dot(self.normal))
    }

    /// The direction s of a beam along `k` in the plane of `source`: n × k, or its limit where k is
    /// along n.
    pub(crate) fn s(&self, k: DVec3, source: DVec3) -> DVec3 {
        let n = self.normal;
        let forward = source.dot(n) * n - source;
        let limit = || n.cross(forward).try_normalize().unwrap_or(self.y);
        n.cross(k).try_normalize().unwrap_or_else(limit)
    }

    /// A random direction of density cos θ/π.
    pub(crate) fn cosine_direction(&self, [a, b]: [f64; 2]) -> DVec3 {
        let (sin_phi, cos_phi) = (TAU * b).sin_cos();
        let (sin, cos) = (a.sqrt(), (1.0 - a).sqrt());
        sin * cos_phi * self.x + sin * sin_phi * self.y + cos * self.normal
    }
}
