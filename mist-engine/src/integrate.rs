//! Model × region → Mueller integral.
//!
//! The integral of S·(M·Φ) cos θ over a region, with S the sensitivity turned along the
//! aperture by the matrix R(β), is S·(∫ R(β)ᵀ M cos θ dΩ)·Φ. The matrix in the middle serves
//! every sensitivity and every incident light.

mod missed;

use std::ops::AddAssign;

use glam::DVec3;
use scattering::{Basis, Direction, Incidence, Model, Mueller, Stokes};

use crate::{
    region::Region,
    sampling::{
        DirectionChunk, Layout, Scale, Scratch,
        adaptive::{self, Accuracy},
    },
    sum,
};

pub(crate) use missed::MissedLobe;

/// The Mueller integral of `model` over `layout`, or nothing if `stop` ends it.
///
/// It is in the units of the BRDF times sr: dimensionless. `stop` is asked once per chunk. The
/// bits do not depend on the number of threads.
pub fn integrate(
    model: &Model,
    incidence: &Incidence,
    basis: Basis,
    layout: &Layout,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<Mueller> {
    integrate_counting(model, incidence, basis, layout, stop).map(|(integral, _)| integral)
}

/// [`integrate`], with the number of directions.
pub(crate) fn integrate_counting(
    model: &Model,
    incidence: &Incidence,
    basis: Basis,
    layout: &Layout,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<(Mueller, u64)> {
    let total = |scratch: &mut Scratch, k| {
        let DirectionChunk { directions, weights } = layout.chunk(k, scratch);
        Total {
            matrix: model.sum(incidence, directions, weights, basis),
            weight: weights.weight.iter().sum(),
            count: directions.len() as u64,
        }
    };
    let sum = sum::ordered(layout.chunks(), stop, total)?;
    let integral = match layout.scale() {
        Scale::Fixed(factor) => sum.matrix * factor,
        Scale::Normalized(area) => {
            Mueller(sum.matrix.0.map(|row| row.map(|x| x / sum.weight * area)))
        }
    };
    Some((integral, sum.count))
}

/// Value of a detector of the sensitivity `pol` for a Mueller integral and the light `inpol`.
pub fn contract(integral: &Mueller, pol: &Stokes, inpol: &Stokes) -> f64 {
    pol.dot(&(*integral * *inpol))
}

/// One direction of an integral and the signal in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Polar angle, radians.
    pub theta: f64,
    /// Azimuth, radians.
    pub phi: f64,
    /// S(β)·(M·Φ), 1/sr.
    pub brdf: f64,
}

impl Sample {
    /// x, y and z of the direction, computed from its angles.
    pub fn xyz(&self) -> [f64; 3] {
        Direction::new(self.theta, self.phi).k().to_array()
    }
}

/// Hands every evaluated direction of an integral to `visit`, in the order of evaluation.
pub fn samples(
    model: &Model,
    incidence: &Incidence,
    basis: Basis,
    layout: &Layout,
    (pol, inpol): (&Stokes, &Stokes),
    visit: &mut dyn FnMut(Sample),
) {
    let below_horizon = !incidence.is_above();
    if layout.is_single_direction() && below_horizon {
        return;
    }
    let mut scratch = Scratch::default();
    for k in 0..layout.chunks() {
        let DirectionChunk { directions, weights } = layout.chunk(k, &mut scratch);
        let mut matrices = vec![Mueller::ZERO; directions.len()];
        model.evaluate(incidence, directions, basis, &mut matrices);
        for (at, (m, d)) in matrices.iter().zip(directions).enumerate() {
            let (cos2b, sin2b) = (weights.cos2b[at], model.turn_sign() * weights.sin2b[at]);
            let brdf = turned(pol, cos2b, sin2b).dot(&(*m * *inpol));
            visit(Sample { theta: d.theta(), phi: d.phi(), brdf });
        }
    }
}

/// Hands the directions of an adaptive integral's last subdivision to `visit`; none where it has
/// no value.
pub(crate) fn adaptive_samples(
    model: &Model,
    incidence: &Incidence,
    basis: Basis,
    (region, accuracy): (&Region, &Accuracy),
    (pol, inpol): (&Stokes, &Stokes),
    visit: &mut dyn FnMut(Sample),
) {
    let show = &mut |v: DVec3, turned: &Mueller| {
        let brdf = contract(turned, pol, inpol);
        visit(Sample { theta: v.z.acos(), phi: v.y.atan2(v.x), brdf });
    };
    // Without a value the run has ended before it comes to samples.
    let _ = adaptive::nodes(model, incidence, basis, region, accuracy, show);
}

/// The sensitivity `s` turned by β: S(β).
fn turned(s: &Stokes, cos2b: f64, sin2b: f64) -> Stokes {
    let [i, q, u, v] = s.0;
    Stokes([i, q * cos2b + u * sin2b, u * cos2b - q * sin2b, v])
}

/// The sums of a part of a layout.
#[derive(Clone, Copy, Debug, Default)]
struct Total {
    matrix: Mueller,
    weight: f64,
    /// Directions.
    count: u64,
}

impl AddAssign for Total {
    fn add_assign(&mut self, other: Self) {
        self.matrix += other.matrix;
        self.weight += other.weight;
        self.count += other.count;
    }
}

#[cfg(test)]
mod tests;
