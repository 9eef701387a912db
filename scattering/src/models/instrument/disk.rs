//! Averages over a cone of directions.
//!
//! A point (r, β) of the unit disk tilts a direction with unit vector r̂ and the unit vectors θ̂,
//! φ̂ across it to
//!
//! $$ \cos(\alpha r)\,\hat r + \sin(\alpha r)(\sin\beta\,\hat\theta - \cos\beta\,\hat\varphi) $$
//!
//! α being the half-angle of the cone. The rule of order N is exact for polynomials of the two
//! coordinates up to degree 2N − 1: 2N equally spaced azimuths on rings whose r² are the nodes on
//! \[0, 1\] of Gauss–Legendre with N/2 points (N even) or of Gauss–Radau with the centre (N odd).
//!
//! A. H. Stroud, *Approximate Calculation of Multiple Integrals* (Prentice-Hall, 1971), section
//! 7.3: spherical product rules for the disk.

use std::f64::consts::PI;

use glam::DVec3;

use crate::{Mueller, ParameterError, ParameterNode, spec::Parameter, special::gauss};

/// A point of the disk.
#[derive(Clone, Copy, Debug)]
pub(super) struct DiskPoint {
    /// Its share; all add up to 1.
    pub weight: f64,
    /// α r, radians.
    angle: f64,
    /// sin β.
    sin: f64,
    /// cos β.
    cos: f64,
}

/// The size of the cone and the order of the rule.
pub(super) const CONE: &[Parameter] = &[
    Parameter::number("alpha", 0.0, "deg", "Half-angle of the cone"),
    Parameter::integer("integralmode", 3, "Order of the rule of integration over the cone"),
];

/// Orders above this one cost more than they can gain.
const HIGHEST_ORDER: i32 = 100;

/// The points for the node's `alpha` and `integralmode`; without a cone only its axis.
pub(super) fn points(node: &ParameterNode) -> Result<Vec<DiskPoint>, ParameterError> {
    let alpha = node.number("alpha");
    if !(0.0..90.0).contains(&alpha) {
        return Err(ParameterError::new("alpha", format!("{alpha} deg is not from 0 to below 90")));
    }
    let order = node.integer("integralmode");
    if !(1..=HIGHEST_ORDER).contains(&order) {
        let problem = format!("{order} is not an order from 1 to {HIGHEST_ORDER}");
        return Err(ParameterError::new("integralmode", problem));
    }
    let order = if alpha == 0.0 { 1 } else { order as usize };
    Ok(rule(order, alpha.to_radians()))
}

fn rule(order: usize, alpha: f64) -> Vec<DiskPoint> {
    let rings = if order.is_multiple_of(2) {
        gauss::legendre(order / 2, 0.0, 1.0)
    } else {
        gauss::radau(order.div_ceil(2), 0.0, 1.0)
    };
    let spokes = 2 * order;
    let mut points = Vec::with_capacity(rings.len() * spokes);
    for (square, weight) in rings {
        if square == 0.0 {
            points.push(DiskPoint { weight, angle: 0.0, sin: 0.0, cos: 1.0 });
            continue;
        }
        points.extend((0..spokes).map(|j| {
            let (sin, cos) = (PI * j as f64 / order as f64).sin_cos();
            DiskPoint { weight: weight / spokes as f64, angle: alpha * square.sqrt(), sin, cos }
        }));
    }
    points
}

impl DiskPoint {
    /// The beam tilted to this point of a cone, the angles of which are multiplied by `factor`.
    pub(super) fn tilt(&self, beam: &ConeAxis, factor: f64) -> DVec3 {
        let (sin, cos) = (self.angle * factor).sin_cos();
        cos * beam.along + sin * (self.sin * beam.across.0 - self.cos * beam.across.1)
    }
}

/// The axis of a cone.
#[derive(Clone, Copy, Debug)]
pub(super) struct ConeAxis {
    /// r̂.
    along: DVec3,
    /// θ̂ and φ̂.
    across: (DVec3, DVec3),
}

impl ConeAxis {
    /// From the sines and cosines of the polar angle and the azimuth.
    pub(super) fn new(sin: f64, cos: f64, sin_phi: f64, cos_phi: f64) -> Self {
        Self {
            along: DVec3::new(sin * cos_phi, sin * sin_phi, cos),
            across: (
                DVec3::new(cos * cos_phi, cos * sin_phi, -sin),
                DVec3::new(-sin_phi, cos_phi, 0.0),
            ),
        }
    }
}

/// Polar angle and azimuth of a unit vector.
pub(super) fn angles(v: DVec3) -> (f64, f64) {
    (v.x.hypot(v.y).atan2(v.z), v.y.atan2(v.x))
}

/// `m` with the basis of its output turned by the angle t: R(t)·m with the matrix
/// [[cos t, sin t], [−sin t, cos t]] of the fields.
pub(super) fn turn_output(mut m: Mueller, t: f64) -> Mueller {
    let (s, c) = (2.0 * t).sin_cos();
    let [q, u] = [m.0[1], m.0[2]];
    for j in 0..4 {
        m.0[1][j] = c * q[j] + s * u[j];
        m.0[2][j] = c * u[j] - s * q[j];
    }
    m
}

/// `m` with the basis of its input turned by the angle t: m·R(t)⁻¹.
pub(super) fn turn_input(mut m: Mueller, t: f64) -> Mueller {
    let (s, c) = (2.0 * t).sin_cos();
    for row in &mut m.0 {
        let [_, q, u, _] = *row;
        row[1] = c * q + s * u;
        row[2] = c * u - s * q;
    }
    m
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Jones;

    #[test]
    fn every_order_is_exact_for_its_polynomials() {
        // ∫ r^(2a) over the disk, divided by π, is 1/(a + 1); cos² β halves it.
        for order in 1..=8 {
            let points = rule(order, 1.0);
            for a in 0..order as i32 {
                let mean: f64 = points.iter().map(|p| p.weight * p.angle.powi(2 * a)).sum();
                assert!((mean - 1.0 / f64::from(a + 1)).abs() < 1e-14, "{order} {a}");
            }
            if order > 1 {
                let x2 = points.iter().map(|p| p.weight * (p.angle * p.cos).powi(2));
                assert!((x2.sum::<f64>() - 0.25).abs() < 1e-14, "{order}");
            }
        }
    }

    #[test]
    fn turning_bases_multiplies_by_the_matrix_of_the_rotation() {
        let m = Mueller::from_row_major(std::array::from_fn(|k| (k as f64).sin()));
        let turn = |t: f64| Jones::real(t.cos(), t.sin(), -t.sin(), t.cos()).mueller();
        assert!((turn_output(m, 0.4) - turn(0.4) * m).largest() < 1e-15);
        assert!((turn_input(m, 0.4) - m * turn(-0.4)).largest() < 1e-15);
    }

    #[test]
    fn a_tilted_direction_lies_on_the_cone() {
        let (theta, phi) = (0.7f64, 2.1f64);
        let beam = ConeAxis::new(theta.sin(), theta.cos(), phi.sin(), phi.cos());
        for point in rule(4, 0.1) {
            let v = point.tilt(&beam, 0.5);
            assert!((v.length() - 1.0).abs() < 1e-15);
            assert!((v.dot(beam.along).acos() - 0.5 * point.angle).abs() < 1e-12);
        }
        assert_eq!(angles(beam.along), (theta, phi));
    }
}
