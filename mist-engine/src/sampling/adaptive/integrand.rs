//! What is integrated: R(β)ᵀ M cos θ as a function of the direction.

use glam::DVec3;
use scattering::{Basis, Direction, Incidence, Model, Mueller, Side, models::Spot};

use super::{Estimate, cell::NODES};
use crate::{
    region::{Angles, Region, unit},
    sampling::{seen, turn::Turn},
};

/// R(β)ᵀ M cos θ of one beam.
pub(super) struct Integrand<'a> {
    model: &'a Model,
    incidence: &'a Incidence,
    basis: Basis,
    turn: Turn,
    flip: f64,
}

impl<'a> Integrand<'a> {
    /// With sensitivities that are given at the centre of `region`.
    pub(super) fn new(
        model: &'a Model,
        incidence: &'a Incidence,
        basis: Basis,
        region: &Region,
    ) -> Self {
        let turn = Turn::towards(region.polarization_center());
        let flip = if model.common().side.to_below() { -1.0 } else { 1.0 };
        Self { model, incidence, basis, turn, flip }
    }

    /// The values at the unit vectors `at`, at most a cell's; zero on and below the horizon.
    pub(super) fn values(&self, at: &[DVec3], out: &mut [Mueller]) {
        let mut directions = [Direction::new(0.0, 0.0); NODES];
        for (direction, v) in directions.iter_mut().zip(at) {
            *direction = seen(*v);
        }
        self.model.evaluate(self.incidence, &directions[..at.len()], self.basis, out);
        for (m, v) in out.iter_mut().zip(at) {
            let [c, s] = self.turn.at(v.to_array());
            let s = self.flip * s;
            let [first, second] = [m.0[1], m.0[2]];
            for k in 0..4 {
                m.0[1][k] = c * first[k] - s * second[k];
                m.0[2][k] = s * first[k] + c * second[k];
            }
            *m *= v.z;
        }
    }

    /// One direction: nothing is left to estimate, and nothing is turned.
    pub(super) fn one(&self, center: Angles) -> Estimate {
        let direction = Direction::new(center.0, center.1);
        let mut out = [Mueller::ZERO];
        self.model.evaluate(self.incidence, &[direction], self.basis, &mut out);
        Estimate { matrix: out[0] * direction.cos, error: Mueller::ZERO, evaluations: 1 }
    }

    /// Where scattered light may gather, the likeliest direction first: where a mirror sends it
    /// or a smooth face refracts it, and back to the source. Models that end behind a second face
    /// have their angles outside of it.
    pub(super) fn gathering(&self) -> Vec<DVec3> {
        let (common, theta) = (self.model.common(), self.incidence.theta());
        let refracted = |sin: f64| unit((sin.clamp(-1.0, 1.0).asin(), 0.0));
        let (sin, n) = (self.incidence.sin, common.substrate.re);
        let straight = unit((theta, 0.0));
        match common.side {
            Side::DownUp | Side::UpDown => vec![straight, unit((-theta, 0.0))],
            Side::DownDown => vec![refracted(sin / n), straight],
            Side::UpUp => vec![refracted(sin * n), straight],
        }
    }

    /// The cones with sharp rims that the model fills.
    pub(super) fn spots(&self) -> Vec<Spot> {
        self.model.spots(self.incidence)
    }
}
