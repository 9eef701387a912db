//! The slices of azimuth around the pole.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI, TAU};

use super::boundary::TINY;

/// Parts of slices are at most this many times as wide as their distance from a ray that touches a
/// circle just outside.
const MOST_HIDDEN: f64 = 4.0;

/// Widest slice, rad.
const WIDEST: f64 = FRAC_PI_2;

/// Azimuths between which the intervals of a ray change smoothly.
#[derive(Clone, Copy, Debug)]
pub(super) struct AzimuthSlice {
    from: f64,
    to: f64,
    /// Distances before and after it at which a ray touches a circle, rad, if any does.
    touching: Option<(f64, f64)>,
}

/// A slice in parts that are not too wide.
pub(super) fn even(from: f64, to: f64, touching: &[f64]) -> Vec<AzimuthSlice> {
    let parts = ((to - from) / WIDEST - 1e-9).ceil().max(1.0);
    let at = |k: usize| from + (to - from) * k as f64 / parts;
    let nearest = |distance: &dyn Fn(&f64) -> f64| {
        let others = touching.iter().map(|p| distance(p).rem_euclid(TAU));
        others.filter(|d| *d > TINY).fold(TAU, f64::min)
    };
    let slice = |k: usize| {
        let (from, to) = (at(k), at(k + 1));
        let touching =
            (!touching.is_empty()).then(|| (nearest(&|p| from - p), nearest(&|p| p - to)));
        AzimuthSlice { from, to, touching }
    };
    (0..parts as usize).map(slice).collect()
}

impl AzimuthSlice {
    /// The azimuth at s in 0..1, and dp/ds.
    ///
    /// Ends at which a ray begins to touch a circle are approached with the square of s: there the
    /// interval grows like a square root of the azimuth, but like s.
    pub(super) fn azimuth(&self, s: f64) -> (f64, f64) {
        let AzimuthSlice { from, to, touching } = *self;
        if touching.is_none() {
            return (from + (to - from) * s, to - from);
        }
        let (sin, cos) = (PI * s).sin_cos();
        (from + (to - from) * 0.5 * (1.0 - cos), (to - from) * 0.5 * PI * sin)
    }

    /// True if `s` is so wide that a ray which touches a circle just outside of the slice could
    /// hide between the nodes: the lengths of intervals go like a square root there, that of s² + h².
    pub(super) fn hides(&self, s: (f64, f64)) -> bool {
        let Some((before, behind)) = self.touching else { return false };
        let near = |end: f64, distance: f64| {
            let h = FRAC_2_PI * (distance / (self.to - self.from)).sqrt();
            s.1 - s.0 > MOST_HIDDEN * end.hypot(h)
        };
        near(s.0, before) || near(1.0 - s.1, behind)
    }
}
