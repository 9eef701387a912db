//! A region in polar coordinates around a pole: slices of azimuth, and along each ray the
//! intervals that belong to the region.
//!
//! Every boundary is a circle on the sphere, the directions v with v·n = c: the rims of cones,
//! the horizon, and the edges of polygons, which lie in planes that contain the normal of the
//! projection. So the ends of the intervals have closed forms, and so have the azimuths at which
//! their number changes: corners, and rays that touch a circle.
//!
//! Rims of spots, across which the integrand jumps, end intervals too.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3};
use scattering::{
    lanes::{Real, sin_cos_of_half_turn, sinh_cosh},
    models::Spot,
};
use smallvec::{SmallVec, smallvec};

use super::{cell::Cell, peaks::Peak};
use crate::region::{Polygon, Region, RegionError, above_horizon, refuse_crossing, unit};

/// Longest first cell along a ray, in w, where t = ε sinh w.
const LONGEST: f64 = 2.0;

/// Ends of intervals that move by more than this in w within a first cell divide it.
const FAR: f64 = 1.3;

/// Halvings of a slice before the first cells are made, for the ends of intervals.
const SPLITS: usize = 6;

/// Halvings towards a ray that touches a circle.
const MOST_SPLITS: usize = 12;

/// Parts of slices are at most this many times as wide as their distance from such a ray.
const MOST_HIDDEN: f64 = 4.0;

/// Widest slice, rad.
const WIDEST: f64 = FRAC_PI_2;

/// Cells towards a peak, at most: 14 halvings both ways need a few hundred.
const MOST_FIRST: usize = 20_000;

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
    /// What is inside of all edges, or of all but the last one, which is an `inner` rim.
    Caps { inner: bool },
    /// What the polygon contains in the projection.
    Polygon(Polygon),
}

/// A region around a pole.
#[derive(Clone, Debug)]
pub(super) struct Rays {
    pole: DVec3,
    /// Azimuth 0 and π/2 around the pole.
    across: (DVec3, DVec3),
    /// What counts as near to the pole, rad: ε of t = ε sinh w.
    near: f64,
    /// The edges of the region, then the rims of spots.
    circles: Vec<Circle>,
    edges: usize,
    inside: Inside,
    slices: Vec<Slice>,
}

/// Azimuths between which the intervals of a ray change smoothly.
#[derive(Clone, Copy, Debug)]
struct Slice {
    from: f64,
    to: f64,
    /// How far before it and behind it a ray touches a circle, rad, if any does.
    touching: Option<(f64, f64)>,
}

/// The part |t − `middle`| < `half` of a ray that is within a circle, rad.
#[derive(Clone, Copy, Debug)]
struct Arc {
    /// −π to π.
    middle: f64,
    /// 0, where the ray misses the circle, to π, where it never leaves it.
    half: f64,
}

impl Arc {
    /// Where the ray at 0 < t < π crosses the circle.
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

/// Intervals of a ray, mostly one or two.
type Intervals = SmallVec<[(f64, f64); 4]>;

/// One interval of one ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    pole: DVec3,
    across: DVec3,
    near: f64,
    w: (f64, f64),
    /// dp/ds.
    per_s: f64,
}

impl Ray {
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
    /// The region as seen from `center`, which is not below the horizon, cut by `spots`.
    pub(super) fn new(region: &Region, center: Peak, spots: &[Spot]) -> Result<Self, RegionError> {
        let pole = center.at;
        let q = pole.any_orthonormal_vector();
        let (mut circles, inside, mut corners) = boundary(&region.ordered())?;
        let edges = circles.len();
        for spot in spots {
            let rim = Circle { normal: spot.axis, cos: spot.half_angle.cos() };
            corners.extend(circles.iter().flat_map(|circle| common_points(circle, &rim)));
            circles.push(rim);
        }
        let across = (q, pole.cross(q));
        let mut rays =
            Self { pole, across, near: center.width, circles, edges, inside, slices: Vec::new() };
        rays.slices = rays.cut(&corners);
        Ok(rays)
    }

    /// The first cells: all intervals of all slices, cut into pieces along the rays and towards
    /// `peaks`.
    pub(super) fn first_cells(&self, peaks: &[Peak]) -> Vec<Cell> {
        let cells = self.even_cells();
        peaks.iter().fold(cells, |cells, peak| self.towards(peak, cells))
    }

    fn even_cells(&self) -> Vec<Cell> {
        let mut cells = Vec::new();
        for slice in 0..self.slices.len() {
            self.split(slice, (0.0, 1.0), 0, &mut cells);
        }
        cells
    }

    /// The cells of a part of a slice: of parts of it in which the ends of intervals move by no
    /// more than FAR, for where an edge passes close to the pole, they run away within a small
    /// angle, and which hide nothing.
    fn split(&self, slice: usize, s: (f64, f64), depth: usize, cells: &mut Vec<Cell>) {
        let middle = 0.5 * (s.0 + s.1);
        // The ends themselves may touch an edge.
        let [first, last] =
            [s.0, s.1].map(|end| self.stretches(slice, end + 1e-3 * (middle - end)));
        let moved = |(a, b): (&(f64, f64), &(f64, f64))| (a.0 - b.0).abs().max((a.1 - b.1).abs());
        let most = first.iter().zip(&last).map(moved).fold(0.0, f64::max);
        let is_split =
            most >= FAR && depth < SPLITS || self.slices[slice].hides(s) && depth < MOST_SPLITS;
        if is_split {
            self.split(slice, (s.0, middle), depth + 1, cells);
            self.split(slice, (middle, s.1), depth + 1, cells);
            return;
        }
        let at = [first, self.stretches(slice, middle), last];
        let count = at.iter().map(SmallVec::len).max().unwrap_or(0);
        for interval in 0..count {
            let lengths = at.iter().filter_map(|all| all.get(interval)).map(|w| w.1 - w.0);
            let pieces = (lengths.fold(0.0, f64::max) / LONGEST).ceil().max(1.0);
            for k in 0..pieces as usize {
                let u = (k as f64 / pieces, (k + 1) as f64 / pieces);
                cells.push(Cell { slice, interval, s, u });
            }
        }
    }

    /// The intervals of a ray in w.
    fn stretches(&self, slice: usize, s: f64) -> Intervals {
        let (p, _) = self.azimuth(slice, s);
        let stretch = |(a, b)| (self.stretched(a), self.stretched(b));
        self.intervals(self.direction(p)).into_iter().map(stretch).collect()
    }

    /// The cells with those near to `peak` halved until they are not wider than the peak, and
    /// else than their distance from it.
    fn towards(&self, peak: &Peak, mut cells: Vec<Cell>) -> Vec<Cell> {
        let mut done = Vec::new();
        while let Some(cell) = cells.pop() {
            let (middle, along_p, along_t) = self.extent(&cell);
            let size = along_p.max(along_t);
            let is_near = middle.distance(peak.at) < along_p + along_t;
            if is_near && size > peak.width && done.len() + cells.len() < MOST_FIRST {
                cells.extend(cell.halves(along_p > along_t));
            } else {
                done.push(cell);
            }
        }
        done
    }

    /// The middle of a cell and how far it reaches along p and along t.
    fn extent(&self, cell: &Cell) -> (DVec3, f64, f64) {
        let at = |s: f64, u: f64| DVec3::from(self.ray(cell.slice, cell.interval, s).at(u).0);
        let (s, u) = (0.5 * (cell.s.0 + cell.s.1), 0.5 * (cell.u.0 + cell.u.1));
        let along_p = at(cell.s.0, u).distance(at(cell.s.1, u));
        (at(s, u), along_p, at(s, cell.u.0).distance(at(s, cell.u.1)))
    }

    /// w of t ≥ 0: the area hyperbolic sine, with the rounding of numbers near 1, which is no more
    /// than that of the angles.
    fn stretched(&self, t: f64) -> f64 {
        let x = t / self.near;
        (x + (x * x + 1.0).sqrt()).ln()
    }

    /// The azimuth at s in 0..1 of a slice, and dp/ds.
    ///
    /// Ends at which a ray begins to touch a circle are approached with the square of s: there the
    /// interval grows like a square root of the azimuth, but like s.
    fn azimuth(&self, slice: usize, s: f64) -> (f64, f64) {
        let Slice { from, to, touching } = self.slices[slice];
        if touching.is_none() {
            return (from + (to - from) * s, to - from);
        }
        let (sin, cos) = (PI * s).sin_cos();
        (from + (to - from) * 0.5 * (1.0 - cos), (to - from) * 0.5 * PI * sin)
    }

    /// One interval of the ray at s of a slice; an empty one if the ray has fewer.
    pub(super) fn ray(&self, slice: usize, interval: usize, s: f64) -> Ray {
        let (p, per_s) = self.azimuth(slice, s);
        let across = self.direction(p);
        let (a, b) = self.intervals(across).get(interval).copied().unwrap_or((0.0, 0.0));
        let w = (self.stretched(a), self.stretched(b));
        Ray { pole: self.pole, across, near: self.near, w, per_s }
    }

    /// The direction of the ray of azimuth `p`, a quarter turn from the pole.
    fn direction(&self, p: f64) -> DVec3 {
        let (sin, cos) = p.sin_cos();
        self.across.0 * cos + self.across.1 * sin
    }

    /// The intervals of t along the ray towards `across` that belong to the region, in order.
    fn intervals(&self, across: DVec3) -> Intervals {
        let arc = |circle: &Circle| {
            let (a, b) = (self.pole.dot(circle.normal), across.dot(circle.normal));
            let cos = circle.cos / (a * a + b * b).sqrt();
            Arc { middle: b.atan2(a), half: cos.clamp(-1.0, 1.0).acos() }
        };
        let arcs: SmallVec<[Arc; 4]> = self.circles.iter().map(arc).collect();
        let mut ends: SmallVec<[(f64, bool); 8]> = smallvec![(0.0, false), (PI, false)];
        for (k, arc) in arcs.iter().enumerate() {
            ends.extend(arc.crossings().map(|t| (t, k >= self.edges)));
        }
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut found = Intervals::new();
        for pair in ends.windows(2) {
            let ((a, is_rim), (b, _)) = (pair[0], pair[1]);
            if b - a < TINY || !self.holds(across, &arcs, 0.5 * (a + b)) {
                continue;
            }
            match found.last_mut() {
                Some(last) if a - last.1 < TINY && !is_rim => last.1 = b,
                _ => found.push((a, b)),
            }
        }
        found
    }

    /// Whether the point at `t` of a ray, which has these arcs, belongs to the region.
    fn holds(&self, across: DVec3, arcs: &[Arc], t: f64) -> bool {
        match &self.inside {
            Inside::Caps { inner } => {
                let (outer, inner) = arcs[..self.edges].split_at(self.edges - usize::from(*inner));
                outer.iter().all(|arc| arc.holds(t)) && !inner.iter().any(|arc| arc.holds(t))
            }
            Inside::Polygon(polygon) => {
                let v = self.pole * t.cos() + across * t.sin();
                v.z > 0.0 && polygon.contains(v.truncate())
            }
        }
    }

    /// The slices between the azimuths at which the intervals of a ray change.
    fn cut(&self, corners: &[DVec3]) -> Vec<Slice> {
        let seen = |v: &DVec3| v.dot(self.across.1).atan2(v.dot(self.across.0)).rem_euclid(TAU);
        let mut ends: Vec<f64> = corners.iter().map(seen).collect();
        let touching: Vec<f64> = self.circles.iter().flat_map(|c| self.touching(c)).collect();
        ends.extend(&touching);
        ends.retain(|p| p.is_finite());
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|b, a| *b - *a < TINY);
        let first = ends.first().copied().unwrap_or(0.0);
        if ends.is_empty() {
            ends.push(first);
        }
        ends.push(first + TAU);
        ends.windows(2).flat_map(|pair| even(pair[0], pair[1], &touching)).collect()
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

/// A slice in parts that are not too wide.
fn even(from: f64, to: f64, touching: &[f64]) -> Vec<Slice> {
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
        Slice { from, to, touching }
    };
    (0..parts as usize).map(slice).collect()
}

impl Slice {
    /// Whether `s` is so wide that a ray which touches a circle just outside of the slice could
    /// hide between the nodes: the lengths of intervals go like a square root there, that of s² + h².
    fn hides(&self, s: (f64, f64)) -> bool {
        let Some((before, behind)) = self.touching else { return false };
        let near = |end: f64, distance: f64| {
            let h = FRAC_2_PI * (distance / (self.to - self.from)).sqrt();
            s.1 - s.0 > MOST_HIDDEN * end.hypot(h)
        };
        near(s.0, before) || near(1.0 - s.1, behind)
    }
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
    Ok((circles, Inside::Caps { inner: inner.is_some() }, corners))
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
