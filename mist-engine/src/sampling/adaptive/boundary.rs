//! The boundary of a region, and the parts of a ray that are within it.
//!
//! Every boundary is a circle on the sphere, the directions v with v·n = c: the rims of cones,
//! the horizon, and the edges of polygons, which lie in planes that contain the normal of the
//! projection. So the ends of the intervals have closed forms, and so have the azimuths at which
//! their number changes: corners, and rays that touch a circle.
//!
//! rims of lobe supports, across which the integrand jumps, end intervals too.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use scattering::models::LobeSupport;
use smallvec::{SmallVec, smallvec};

use crate::region::{Polygon, Region, RegionError, above_horizon, refuse_crossing, unit};

/// Shorter intervals and slices are left out, rad.
pub(super) const TINY: f64 = 1e-13;

/// The directions v with v·`normal` = `cos`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Circle {
    normal: DVec3,
    cos: f64,
}

/// Part of the region above the horizon.
#[derive(Clone, Debug)]
enum Interior {
    /// Region inside of all edges, or of all but the last one, which is an `inner` rim.
    Caps { inner: bool },
    /// Region that the polygon contains in the projection.
    Polygon(Polygon),
}

/// Boundary of a region.
#[derive(Clone, Debug)]
pub(super) struct RegionBoundary {
    /// The edges, then the rims of supports.
    pub(super) circles: Vec<Circle>,
    edges: usize,
    inside: Interior,
    /// Intersections of circles.
    pub(super) corners: Vec<DVec3>,
}

/// Intervals of a ray, mostly one or two.
pub(super) type Intervals = SmallVec<[(f64, f64); 4]>;

/// The part |t − `middle`| < `half` of a ray that is within a circle, rad.
#[derive(Clone, Copy, Debug)]
struct Arc {
    /// −π to π.
    middle: f64,
    /// 0, where the ray misses the circle, to π, where it never leaves it.
    half: f64,
}

impl Arc {
    /// Intersections of the ray at 0 < t < π with the circle.
    fn crossings(self) -> impl Iterator<Item = f64> {
        let ends = [self.middle - self.half, self.middle + self.half];
        let ahead = ends.map(|t| if t < 0.0 { t + TAU } else { t });
        let crosses = self.half > 0.0 && self.half < PI;
        ahead.into_iter().filter(move |t| crosses && *t > 0.0 && *t < PI)
    }

    fn holds(self, t: f64) -> bool {
        let off = (t - self.middle).abs();
        off.min(TAU - off) < self.half
    }
}

impl Circle {
    const HORIZON: Self = Self { normal: DVec3::Z, cos: 0.0 };

    /// The part of the ray from `pole` towards `across` with v·n > c.
    fn arc(&self, pole: DVec3, across: DVec3) -> Arc {
        let (a, b) = (pole.dot(self.normal), across.dot(self.normal));
        let cos = self.cos / (a * a + b * b).sqrt();
        Arc { middle: b.atan2(a), half: cos.clamp(-1.0, 1.0).acos() }
    }

    /// The azimuths, counted from the first of `axes`, of the rays from `pole` that touch it.
    pub(super) fn touching(&self, pole: DVec3, axes: (DVec3, DVec3)) -> Vec<f64> {
        let a = pole.dot(self.normal);
        let (x, y) = (self.normal.dot(axes.0), self.normal.dot(axes.1));
        let cosine = ((self.cos * self.cos - a * a).max(0.0)).sqrt() / x.hypot(y);
        if self.cos.abs() < a.abs() || cosine.is_nan() || cosine > 1.0 {
            return Vec::new();
        }
        let half = cosine.acos();
        let all = [half, -half, PI - half, half - PI];
        all.map(|p| (y.atan2(x) + p).rem_euclid(TAU)).to_vec()
    }
}

impl RegionBoundary {
    /// The boundary of `region` and the rims of `supports`.
    pub(super) fn new(region: &Region, supports: &[LobeSupport]) -> Result<Self, RegionError> {
        let mut boundary = Self::of(region)?;
        for support in supports {
            let rim = Circle { normal: support.axis, cos: support.half_angle.cos() };
            let circles = boundary.circles.iter();
            boundary.corners.extend(circles.flat_map(|circle| common_points(circle, &rim)));
            boundary.circles.push(rim);
        }
        Ok(boundary)
    }

    fn of(region: &Region) -> Result<Self, RegionError> {
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
        let circles: Vec<Circle> =
            [Some(Circle::HORIZON), outer, inner].into_iter().flatten().collect();
        let mut corners = Vec::new();
        for (k, first) in circles.iter().enumerate() {
            for second in &circles[k + 1..] {
                corners.extend(common_points(first, second));
            }
        }
        let inside = Interior::Caps { inner: inner.is_some() };
        Ok(Self { edges: circles.len(), circles, inside, corners })
    }

    /// The intervals of t along the ray from `pole` towards `across`, a quarter turn from it, that
    /// belong to the region, in order.
    pub(super) fn intervals(&self, pole: DVec3, across: DVec3) -> Intervals {
        let arcs: SmallVec<[Arc; 4]> =
            self.circles.iter().map(|circle| circle.arc(pole, across)).collect();
        let mut ends: SmallVec<[(f64, bool); 8]> = smallvec![(0.0, false), (PI, false)];
        for (k, arc) in arcs.iter().enumerate() {
            ends.extend(arc.crossings().map(|t| (t, k >= self.edges)));
        }
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut found = Intervals::new();
        for pair in ends.windows(2) {
            let ((a, is_rim), (b, _)) = (pair[0], pair[1]);
            if b - a < TINY || !self.holds((pole, across), &arcs, 0.5 * (a + b)) {
                continue;
            }
            match found.last_mut() {
                Some(last) if a - last.1 < TINY && !is_rim => last.1 = b,
                _ => found.push((a, b)),
            }
        }
        found
    }

    /// True if the point at `t` of a ray, which has these arcs, belongs to the region.
    fn holds(&self, (pole, across): (DVec3, DVec3), arcs: &[Arc], t: f64) -> bool {
        match &self.inside {
            Interior::Caps { inner } => {
                let (outer, inner) = arcs[..self.edges].split_at(self.edges - usize::from(*inner));
                outer.iter().all(|arc| arc.holds(t)) && !inner.iter().any(|arc| arc.holds(t))
            }
            Interior::Polygon(polygon) => {
                let v = pole * t.cos() + across * t.sin();
                v.z > 0.0 && polygon.contains(v.truncate())
            }
        }
    }
}

/// Intersections of two circles.
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

fn polygon(corners: Vec<DVec3>) -> Result<RegionBoundary, RegionError> {
    let plane: Vec<DVec2> = corners.iter().map(|v| v.truncate()).collect();
    let polygon = Polygon::new(plane.clone());
    refuse_crossing(polygon.crossing(true))?;
    let mut circles = vec![Circle::HORIZON];
    for (k, a) in plane.iter().enumerate() {
        let b = plane[(k + 1) % plane.len()];
        let normal = (b - *a).perp().normalize_or_zero();
        if normal != DVec2::ZERO {
            circles.push(Circle { normal: normal.extend(0.0), cos: normal.dot(*a) });
        }
    }
    Ok(RegionBoundary {
        edges: circles.len(),
        circles,
        inside: Interior::Polygon(polygon),
        corners,
    })
}
