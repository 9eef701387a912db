//! A region in polar coordinates around a pole: slices of azimuth, and along each ray the
//! intervals that belong to the region.

use std::f64::consts::TAU;

use glam::DVec3;
use scattering::{
    lanes::{Real, sin_cos_of_half_turn, sinh_cosh},
    models::LobeSupport,
};

use super::{
    boundary::{Intervals, RegionBoundary, TINY},
    peaks::Peak,
    slice::{AzimuthSlice, even},
};
use crate::region::{PolarCell, Region, RegionError};

/// A region around a pole.
#[derive(Clone, Debug)]
pub(super) struct Rays {
    pole: DVec3,
    /// Azimuth 0 and π/2 around the pole.
    across: (DVec3, DVec3),
    /// Distance that counts as near to the pole, rad: ε of t = ε sinh w.
    near: f64,
    boundary: RegionBoundary,
    pub(super) slices: Vec<AzimuthSlice>,
}

/// One interval of one ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct PolarRay {
    pole: DVec3,
    across: DVec3,
    near: f64,
    w: (f64, f64),
    /// dp/ds.
    per_s: f64,
}

impl PolarRay {
    /// The direction at u in 0..1 along the interval, and dΩ/(ds du); or those of several u.
    #[inline(always)]
    pub(super) fn at<R: Real>(&self, u: R) -> ([R; 3], R) {
        let length = self.w.1 - self.w.0;
        let [sinh, cosh] = sinh_cosh(u * length + self.w.0);
        let [sin, cos] = sin_cos_of_half_turn(sinh * self.near);
        let (pole, across) = (self.pole, self.across);
        let v = [
            cos * pole.x + sin * across.x,
            cos * pole.y + sin * across.y,
            cos * pole.z + sin * across.z,
        ];
        (v, sin * cosh * (self.near * length * self.per_s))
    }
}

impl Rays {
    /// The region as seen from `center`, which is not below the horizon, cut by `supports`.
    pub(super) fn new(
        region: &Region,
        center: Peak,
        supports: &[LobeSupport],
    ) -> Result<Self, RegionError> {
        let pole = center.at;
        let q = pole.any_orthonormal_vector();
        let boundary = RegionBoundary::new(&region.ordered(), supports)?;
        let (across, near) = ((q, pole.cross(q)), center.width);
        let mut rays = Self { pole, across, near, boundary, slices: Vec::new() };
        rays.slices = rays.cut(None);
        Ok(rays)
    }

    /// The cell as seen from the normal, cut by `supports`.
    pub(super) fn of_cell(cell: &PolarCell, supports: &[LobeSupport]) -> Result<Self, RegionError> {
        let band = Region::Annulus {
            outer_center: (0.0, 0.0),
            outer_alpha: cell.theta.1,
            inner_center: (0.0, 0.0),
            inner_alpha: cell.theta.0,
        };
        let boundary = RegionBoundary::new(&band, supports)?;
        let across = (DVec3::X, DVec3::Y);
        let mut rays = Self { pole: DVec3::Z, across, near: 1.0, boundary, slices: Vec::new() };
        rays.slices = rays.cut(Some(cell.phi));
        Ok(rays)
    }

    /// The intervals of a ray in w.
    pub(super) fn stretches(&self, slice: usize, s: f64) -> Intervals {
        let (p, _) = self.slices[slice].azimuth(s);
        let stretch = |(a, b)| (self.stretched(a), self.stretched(b));
        self.boundary.intervals(self.pole, self.direction(p)).into_iter().map(stretch).collect()
    }

    /// w of t ≥ 0: the area hyperbolic sine, with the rounding of numbers near 1, which is no more
    /// than that of the angles.
    fn stretched(&self, t: f64) -> f64 {
        let x = t / self.near;
        (x + (x * x + 1.0).sqrt()).ln()
    }

    /// One interval of the ray at s of a slice; an empty one if the ray has fewer.
    pub(super) fn ray(&self, slice: usize, interval: usize, s: f64) -> PolarRay {
        let (p, per_s) = self.slices[slice].azimuth(s);
        let across = self.direction(p);
        let intervals = self.boundary.intervals(self.pole, across);
        let (a, b) = intervals.get(interval).copied().unwrap_or((0.0, 0.0));
        let w = (self.stretched(a), self.stretched(b));
        PolarRay { pole: self.pole, across, near: self.near, w, per_s }
    }

    /// The direction of the ray of azimuth `p`, a quarter turn from the pole.
    fn direction(&self, p: f64) -> DVec3 {
        let (sin, cos) = p.sin_cos();
        self.across.0 * cos + self.across.1 * sin
    }

    /// The slices between the azimuths at which the intervals of a ray change, within `sector` or all
    /// around.
    fn cut(&self, sector: Option<(f64, f64)>) -> Vec<AzimuthSlice> {
        let seen = |v: &DVec3| v.dot(self.across.1).atan2(v.dot(self.across.0)).rem_euclid(TAU);
        let mut ends: Vec<f64> = self.boundary.corners.iter().map(seen).collect();
        let touching =
            self.boundary.circles.iter().flat_map(|c| c.touching(self.pole, self.across));
        let touching: Vec<f64> = touching.collect();
        ends.extend(&touching);
        ends.retain(|p| p.is_finite());
        if let Some((from, to)) = sector {
            ends.iter_mut().for_each(|p| *p = from + (*p - from).rem_euclid(TAU));
            ends.retain(|p| *p - from > TINY && to - *p > TINY);
            ends.extend([from, to]);
        }
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|b, a| *b - *a < TINY);
        if sector.is_some() {
            return ends.windows(2).flat_map(|pair| even(pair[0], pair[1], &touching)).collect();
        }
        let first = ends.first().copied().unwrap_or(0.0);
        if ends.is_empty() {
            ends.push(first);
        }
        ends.push(first + TAU);
        ends.windows(2).flat_map(|pair| even(pair[0], pair[1], &touching)).collect()
    }
}
