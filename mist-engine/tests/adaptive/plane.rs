//! Reference integrals by a method that shares nothing with the adaptive one but the model.
//!
//! ∫ M cos θ dΩ = ∫∫ M dx dy in the plane of direction cosines, in polar coordinates (ρ, ψ)
//! around the mirror direction. Along a ray the edges of the region are roots of quadratics; the
//! azimuths at which they appear, vanish or bend are found by bisection. Between them, tensor
//! products of Gauss–Legendre rules of fixed order, with panels that grow with the distance from
//! the middle. Along a ray they are in √(ρ_h − ρ), ρ_h its end on the horizon, which takes away the
//! square roots that are left there; ψ = a + (b − a)(1 − cos πu)/2 does so at corners and where a
//! ray begins to touch an edge.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use mist_engine::region::Region;
use scattering::{Basis, Direction, Incidence, Model, Mueller, special::gauss};

/// The directions v with v·`normal` = `cos`.
#[derive(Clone, Copy)]
struct Edge {
    normal: DVec3,
    cos: f64,
}

impl Edge {
    fn side(&self, v: DVec3) -> f64 {
        v.dot(self.normal) - self.cos
    }

    /// Points of the edge, in order.
    fn at(&self, t: f64) -> DVec3 {
        let q = self.normal.any_orthonormal_vector();
        let p = self.normal.cross(q);
        let sin = (1.0 - self.cos * self.cos).sqrt();
        self.normal * self.cos + (q * t.cos() + p * t.sin()) * sin
    }
}

struct Plane {
    center: DVec2,
    edges: Vec<Edge>,
    corners: Vec<DVec3>,
    polygon: Vec<DVec2>,
    caps: (Option<Edge>, Option<Edge>),
}

fn unit((theta, phi): (f64, f64)) -> DVec3 {
    DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos())
}

/// The direction with the cosines `xy`, if there is one.
fn lifted(xy: DVec2) -> DVec3 {
    xy.extend((1.0 - xy.length_squared()).max(0.0).sqrt())
}

impl Plane {
    fn new(region: &Region, center: DVec2) -> Self {
        let cap = |c: (f64, f64), alpha: f64| Edge { normal: unit(c), cos: alpha.cos() };
        let mut plane = Self {
            center,
            edges: Vec::new(),
            corners: Vec::new(),
            polygon: Vec::new(),
            caps: (None, None),
        };
        match region {
            Region::Hemi | Region::Differential { .. } => {}
            Region::Circle { center, alpha } => plane.caps.0 = Some(cap(*center, *alpha)),
            Region::Annulus { outer_center, outer_alpha, inner_center, inner_alpha } => {
                plane.caps = (
                    Some(cap(*outer_center, *outer_alpha)),
                    Some(cap(*inner_center, *inner_alpha)),
                );
            }
            Region::Polygon { vertices, .. } => {
                plane.polygon = vertices.iter().map(|v| unit(*v).truncate()).collect();
            }
        }
        plane.edges.extend(plane.caps.0);
        plane.edges.extend(plane.caps.1);
        for k in 0..plane.polygon.len() {
            let (a, b) = (plane.polygon[k], plane.polygon[(k + 1) % plane.polygon.len()]);
            let across = (b - a).perp().normalize();
            plane.edges.push(Edge { normal: across.extend(0.0), cos: across.dot(a) });
            plane.corners.push(lifted(a));
        }
        let horizon = Edge { normal: DVec3::Z, cos: 0.0 };
        let mut all = plane.edges.clone();
        all.push(horizon);
        for (k, edge) in plane.edges.iter().enumerate() {
            for other in all.iter().enumerate().filter(|(m, _)| *m != k).map(|(_, other)| other) {
                let side = |t: f64| other.side(edge.at(t));
                let found = changes(&|t| side(t) > 0.0);
                plane.corners.extend(found.into_iter().map(|t| edge.at(t)));
            }
        }
        plane
    }

    fn holds(&self, xy: DVec2) -> bool {
        let v = lifted(xy);
        let is_inside = |p: DVec2| {
            let n = self.polygon.len();
            let crossed = (0..n).filter(|k| {
                let (a, b) = (self.polygon[*k], self.polygon[(*k + 1) % n]);
                (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)
            });
            crossed.count() % 2 == 1
        };
        xy.length_squared() < 1.0
            && self.caps.0.is_none_or(|edge| edge.side(v) > 0.0)
            && self.caps.1.is_none_or(|edge| edge.side(v) < 0.0)
            && (self.polygon.is_empty() || is_inside(xy))
    }

    /// ρ of the horizon on the ray ψ.
    fn horizon(&self, psi: f64) -> f64 {
        let along = self.center.dot(DVec2::from_angle(psi));
        -along + (along * along + 1.0 - self.center.length_squared()).sqrt()
    }

    /// The intervals of ρ along the ray ψ that belong to the region.
    fn intervals(&self, psi: f64) -> Vec<(f64, f64)> {
        let (c, e) = (self.center, DVec2::from_angle(psi));
        let (along, end) = (c.dot(e), self.horizon(psi));
        let mut ends = vec![0.0, end];
        for edge in &self.edges {
            let n = edge.normal.truncate();
            let (a, b, z2) = (edge.cos - n.dot(c), n.dot(e), edge.normal.z.powi(2));
            // The circle of a cone around the horizon is a line as well, up to the rounding of its axis.
            if z2 < 1e-30 {
                ends.push(a / b);
                continue;
            }
            // (a − bρ)² = n_z² (1 − |c + ρe|²)
            let (p, q) = (b * b + z2, z2 * along - a * b);
            let r = a * a - z2 * (1.0 - c.length_squared());
            let root = (q * q - p * r).sqrt();
            ends.extend([(-q - root) / p, (-q + root) / p]);
        }
        ends.retain(|rho| *rho >= 0.0 && *rho <= end);
        ends.sort_by(f64::total_cmp);
        let mut found: Vec<(f64, f64)> = Vec::new();
        for pair in ends.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            if b - a < 1e-13 || !self.holds(c + e * (0.5 * (a + b))) {
                continue;
            }
            match found.last_mut() {
                Some(last) if a - last.1 < 1e-13 => last.1 = b,
                _ => found.push((a, b)),
            }
        }
        found
    }

    /// The azimuths between which the ends of the intervals are smooth.
    fn azimuths(&self) -> Vec<f64> {
        let seen = |v: &DVec3| {
            let d = v.truncate() - self.center;
            d.y.atan2(d.x).rem_euclid(TAU)
        };
        let mut all: Vec<f64> = self.corners.iter().map(seen).collect();
        for count in 1..4 {
            let found = changes(&|psi| self.intervals(psi).len() >= count);
            all.extend(found.into_iter().map(|psi| psi.rem_euclid(TAU)));
        }
        all.extend([0.0, TAU]);
        all.sort_by(f64::total_cmp);
        all.dedup_by(|b, a| *b - *a < 1e-12);
        all
    }
}

/// Places at which `is` changes around the circle, to the last bit; 0 and other likely ones lie between
/// two steps.
fn changes(is: &dyn Fn(f64) -> bool) -> Vec<f64> {
    const STEPS: usize = 4000;
    let at = |k: usize| 0.1234 + TAU * k as f64 / STEPS as f64;
    let mut found = Vec::new();
    for k in 0..STEPS {
        let (mut a, mut b) = (at(k), at(k + 1));
        let first = is(a);
        if first == is(b) {
            continue;
        }
        for _ in 0..60 {
            let middle = 0.5 * (a + b);
            if is(middle) == first { a = middle } else { b = middle }
        }
        found.push(0.5 * (a + b));
    }
    found
}

/// Nodes and weights on a panel, denser towards both ends.
fn panel(rule: &[(f64, f64)], a: f64, b: f64) -> Vec<(f64, f64)> {
    let half = 0.5 * (b - a);
    let mapped = |(u, w): &(f64, f64)| {
        let (sin, cos) = (PI * u).sin_cos();
        (a + half * (1.0 - cos), w * half * PI * sin)
    };
    rule.iter().map(mapped).collect()
}

/// Nodes and weights in ρ from `a` to `b`, by a rule in √(`end` − ρ).
fn ray(rule: &[(f64, f64)], a: f64, b: f64, end: f64) -> Vec<(f64, f64)> {
    let (low, high) = ((end - b).max(0.0).sqrt(), (end - a).sqrt());
    let mapped = |(u, w): &(f64, f64)| {
        let root = low + (high - low) * u;
        (end - root * root, 2.0 * root * (high - low) * w)
    };
    rule.iter().map(mapped).collect()
}

/// Ends of panels from `from` to `to` that are fine near both, where the ends of intervals may run
/// away from a pole on an edge, and nowhere wider than 0.15 rad.
fn graded(from: f64, to: f64) -> Vec<f64> {
    let middle = 0.5 * (to - from);
    let steps: Vec<f64> = std::iter::successors(Some(1e-5_f64), |step| Some(step + step.min(0.15)))
        .take_while(|step| *step < 0.9 * middle)
        .collect();
    let rising = steps.iter().map(|step| from + step);
    let falling = steps.iter().rev().map(|step| to - step);
    [from].into_iter().chain(rising).chain([from + middle]).chain(falling).chain([to]).collect()
}

/// Ends of the panels along a ray, in widths of the lobe.
const WIDTHS: [f64; 15] =
    [0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 32.0, 64.0, 200.0, 600.0];

/// The integral of `model` over `region` by rules of `order` points; `width` is that of the lobe
/// in direction cosines.
pub(crate) fn integral(
    model: &Model,
    theta_i: f64,
    region: &Region,
    width: f64,
    order: usize,
) -> Mueller {
    let incidence = Incidence::new(theta_i, 0.0);
    let plane = Plane::new(region, unit((theta_i, 0.0)).truncate());
    let rule: Vec<(f64, f64)> = gauss::legendre(order, 0.0, 1.0);
    let mut sum = Mueller::ZERO;
    for pair in plane.azimuths().windows(2) {
        for ends in graded(pair[0], pair[1]).windows(2) {
            for (psi, weight) in panel(&rule, ends[0], ends[1]) {
                let e = DVec2::from_angle(psi);
                for (a, b) in plane.intervals(psi) {
                    let inner = WIDTHS.iter().map(|w| w * width).filter(|r| *r > a && *r < b);
                    let ends: Vec<f64> = [a].into_iter().chain(inner).chain([b]).collect();
                    for ends in ends.windows(2) {
                        for (rho, w) in ray(&rule, ends[0], ends[1], plane.horizon(psi)) {
                            let at = plane.center + e * rho;
                            sum += value(model, &incidence, at) * (w * weight * rho);
                        }
                    }
                }
            }
        }
    }
    sum
}

fn value(model: &Model, incidence: &Incidence, xy: DVec2) -> Mueller {
    let v = lifted(xy);
    let sin = xy.length();
    let direction = Direction::from_sin_cos((sin, v.z), xy.y.atan2(xy.x).sin_cos());
    let mut out = [Mueller::ZERO];
    model.evaluate(incidence, &[direction], Basis::Psps, &mut out);
    out[0]
}
