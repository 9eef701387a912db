//! A region in polar coordinates around a pole: slices of azimuth, and along each ray the
//! intervals that belong to the region.
//!
//! Every boundary is a circle on the sphere, the directions v with v·n = c: the rims of cones,
//! the horizon, and the edges of polygons, which lie in planes that contain the normal of the
//! projection. So the ends of the intervals have closed forms, and so have the azimuths at which
//! their number changes: corners, and rays that touch a circle.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3};

use super::cell::Cell;
use crate::region::{Polygon, Region, RegionError, above_horizon, refuse_crossing, unit};

/// Narrowest lobe around the pole that looks wide along a ray, rad.
const NARROW: f64 = 1e-4;

/// Longest first cell along a ray, in w, where t = NARROW sinh w.
const LONGEST: f64 = 2.6;

/// Widest slice, rad.
const WIDEST: f64 = FRAC_PI_2;

/// Shorter intervals and slices are left out, rad.
const TINY: f64 = 1e-13;

/// The directions v with v·`normal` = `cos`.
#[derive(Clone, Copy, Debug)]
struct Circle {
    normal: DVec3,
    cos: f64,
}

/// What belongs to the region, above the horizon.
#[derive(Clone, Debug)]
enum Inside {
    /// What is inside of the first circle, if there is one, and outside of the second.
    Caps { outer: Option<Circle>, inner: Option<Circle> },
    /// What the polygon contains in the projection.
    Polygon(Polygon),
}

/// A region around a pole.
#[derive(Clone, Debug)]
pub(super) struct Rays {
    pole: DVec3,
    /// Azimuth 0 and π/2 around the pole.
    across: (DVec3, DVec3),
    circles: Vec<Circle>,
    inside: Inside,
    slices: Vec<(f64, f64)>,
}

/// One interval of one ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    pole: DVec3,
    across: DVec3,
    w: (f64, f64),
    /// dp/ds.
    per_s: f64,
}

impl Ray {
    /// The direction at u in 0..1 along the interval, and dΩ/(ds du).
    pub(super) fn at(&self, u: f64) -> (DVec3, f64) {
        let length = self.w.1 - self.w.0;
        let w = self.w.0 + length * u;
        let (sin, cos) = (NARROW * w.sinh()).sin_cos();
        let v = self.pole * cos + self.across * sin;
        (v, sin * NARROW * w.cosh() * length * self.per_s)
    }
}

impl Rays {
    /// The region as seen from `pole`, a unit vector not below the horizon.
    pub(super) fn new(region: &Region, pole: DVec3) -> Result<Self, RegionError> {
        let q = pole.any_orthonormal_vector();
        let (circles, inside, corners) = boundary(&region.ordered())?;
        let mut rays =
            Self { pole, across: (q, pole.cross(q)), circles, inside, slices: Vec::new() };
        rays.slices = rays.cut(&corners);
        Ok(rays)
    }

    /// The first cells: all intervals of all slices, cut into pieces along the rays.
    pub(super) fn first_cells(&self) -> Vec<Cell> {
        let mut cells = Vec::new();
        for slice in 0..self.slices.len() {
            let lengths = [0.1, 0.5, 0.9].map(|s| self.lengths(slice, s));
            let count = lengths.iter().map(Vec::len).max().unwrap_or(0);
            for interval in 0..count {
                let along = lengths.iter().filter_map(|l| l.get(interval));
                let longest = along.fold(0.0_f64, |a, b| a.max(*b));
                let pieces = (longest / LONGEST).ceil().max(1.0);
                for k in 0..pieces as usize {
                    let u = (k as f64 / pieces, (k + 1) as f64 / pieces);
                    cells.push(Cell { slice, interval, s: (0.0, 1.0), u });
                }
            }
        }
        cells
    }

    fn lengths(&self, slice: usize, s: f64) -> Vec<f64> {
        let (p, _) = self.azimuth(slice, s);
        self.intervals(p).into_iter().map(|(a, b)| stretched(b) - stretched(a)).collect()
    }

    /// The azimuth at s in 0..1 of a slice, and dp/ds.
    ///
    /// Both ends are approached with the square of s: where a ray begins to touch a circle, the
    /// interval grows like a square root of the azimuth, but like s.
    fn azimuth(&self, slice: usize, s: f64) -> (f64, f64) {
        let (from, to) = self.slices[slice];
        let (sin, cos) = (PI * s).sin_cos();
        (from + (to - from) * 0.5 * (1.0 - cos), (to - from) * 0.5 * PI * sin)
    }

    /// One interval of the ray at s of a slice; an empty one if the ray has fewer.
    pub(super) fn ray(&self, slice: usize, interval: usize, s: f64) -> Ray {
        let (p, per_s) = self.azimuth(slice, s);
        let (a, b) = self.intervals(p).get(interval).copied().unwrap_or((0.0, 0.0));
        let w = (stretched(a), stretched(b));
        Ray { pole: self.pole, across: self.direction(p), w, per_s }
    }

    fn direction(&self, p: f64) -> DVec3 {
        self.across.0 * p.cos() + self.across.1 * p.sin()
    }

    /// The intervals of t along the ray of azimuth p that belong to the region, in order.
    fn intervals(&self, p: f64) -> Vec<(f64, f64)> {
        let across = self.direction(p);
        let mut ends = vec![0.0, PI];
        for circle in &self.circles {
            let (a, b) = (self.pole.dot(circle.normal), across.dot(circle.normal));
            let (middle, half) = (b.atan2(a), (circle.cos / a.hypot(b)).acos());
            // Half is NaN where the ray misses the circle.
            let crossings = [middle - half, middle + half].map(|t| t.rem_euclid(TAU));
            ends.extend(crossings.into_iter().filter(|t| *t > 0.0 && *t < PI));
        }
        ends.sort_by(f64::total_cmp);
        let mut found: Vec<(f64, f64)> = Vec::new();
        for pair in ends.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            let t = 0.5 * (a + b);
            if b - a < TINY || !self.holds(self.pole * t.cos() + across * t.sin()) {
                continue;
            }
            match found.last_mut() {
                Some(last) if a - last.1 < TINY => last.1 = b,
                _ => found.push((a, b)),
            }
        }
        found
    }

    fn holds(&self, v: DVec3) -> bool {
        v.z > 0.0
            && match &self.inside {
                Inside::Caps { outer, inner } => {
                    outer.is_none_or(|c| v.dot(c.normal) > c.cos)
                        && inner.is_none_or(|c| v.dot(c.normal) < c.cos)
                }
                Inside::Polygon(polygon) => polygon.contains(v.truncate()),
            }
    }

    /// The slices between the azimuths at which the intervals of a ray change.
    fn cut(&self, corners: &[DVec3]) -> Vec<(f64, f64)> {
        let seen = |v: &DVec3| v.dot(self.across.1).atan2(v.dot(self.across.0)).rem_euclid(TAU);
        let mut ends: Vec<f64> = corners.iter().map(seen).collect();
        ends.extend(self.circles.iter().flat_map(|c| self.touching(c)));
        ends.retain(|p| p.is_finite());
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|b, a| *b - *a < TINY);
        let first = ends.first().copied().unwrap_or(0.0);
        if ends.is_empty() {
            ends.push(first);
        }
        ends.push(first + TAU);
        ends.windows(2).flat_map(|pair| even(pair[0], pair[1])).collect()
    }

    /// The azimuths of the rays that touch a circle.
    fn touching(&self, circle: &Circle) -> Vec<f64> {
        let a = self.pole.dot(circle.normal);
        let (x, y) = (circle.normal.dot(self.across.0), circle.normal.dot(self.across.1));
        let cosine = ((circle.cos * circle.cos - a * a).max(0.0)).sqrt() / x.hypot(y);
        if circle.cos.abs() < a.abs() || cosine.is_nan() || cosine > 1.0 {
            return Vec::new();
        }
        let half = cosine.acos();
        let all = [half, -half, PI - half, half - PI];
        all.map(|p| (y.atan2(x) + p).rem_euclid(TAU)).to_vec()
    }
}

/// w of t.
fn stretched(t: f64) -> f64 {
    (t / NARROW).asinh()
}

/// A slice in parts that are not too wide.
fn even(from: f64, to: f64) -> Vec<(f64, f64)> {
    let parts = ((to - from) / WIDEST - 1e-9).ceil().max(1.0);
    let at = |k: f64| from + (to - from) * k / parts;
    (0..parts as usize).map(|k| (at(k as f64), at(k as f64 + 1.0))).collect()
}

/// The circles that bound a region, what is inside, and its corners.
fn boundary(region: &Region) -> Result<(Vec<Circle>, Inside, Vec<DVec3>), RegionError> {
    let cap = |center, alpha: f64| {
        (alpha.abs() < PI).then(|| Circle { normal: unit(center), cos: alpha.cos() })
    };
    let (outer, inner) = match region {
        Region::Polygon { vertices, .. } => {
            above_horizon(vertices)?;
            return polygon(vertices.iter().map(|v| unit(*v)).collect());
        }
        Region::Differential { .. } | Region::Hemi => (None, None),
        Region::Circle { center, alpha } => (cap(*center, *alpha), None),
        Region::Annulus { outer_center, outer_alpha, inner_center, inner_alpha } => {
            (cap(*outer_center, *outer_alpha), cap(*inner_center, *inner_alpha))
        }
    };
    let horizon = Circle { normal: DVec3::Z, cos: 0.0 };
    let circles: Vec<Circle> = [Some(horizon), outer, inner].into_iter().flatten().collect();
    let mut corners = Vec::new();
    for (k, first) in circles.iter().enumerate() {
        for second in &circles[k + 1..] {
            corners.extend(common_points(first, second));
        }
    }
    Ok((circles, Inside::Caps { outer, inner }, corners))
}

/// Where two circles cross.
fn common_points(first: &Circle, second: &Circle) -> Vec<DVec3> {
    let (m, n) = (first.normal, second.normal);
    let (k, axis) = (m.dot(n), m.cross(n));
    let square = axis.length_squared();
    let middle =
        m * ((first.cos - second.cos * k) / square) + n * ((second.cos - first.cos * k) / square);
    let along = ((1.0 - middle.length_squared()) / square).sqrt();
    // NaN for circles that do not cross, or that are parallel.
    if along.is_finite() { vec![middle + axis * along, middle - axis * along] } else { Vec::new() }
}

fn polygon(corners: Vec<DVec3>) -> Result<(Vec<Circle>, Inside, Vec<DVec3>), RegionError> {
    let plane: Vec<DVec2> = corners.iter().map(|v| v.truncate()).collect();
    let polygon = Polygon::new(plane.clone());
    refuse_crossing(polygon.crossing(true))?;
    let mut circles = vec![Circle { normal: DVec3::Z, cos: 0.0 }];
    for (k, a) in plane.iter().enumerate() {
        let b = plane[(k + 1) % plane.len()];
        let normal = (b - *a).perp().normalize_or_zero();
        if normal != DVec2::ZERO {
            circles.push(Circle { normal: normal.extend(0.0), cos: normal.dot(*a) });
        }
    }
    Ok((circles, Inside::Polygon(polygon), corners))
}
