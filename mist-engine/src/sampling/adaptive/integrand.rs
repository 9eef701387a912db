//! The integrand R(β)ᵀ M cos θ as a function of the direction.

use glam::DVec3;
use scattering::{
    Basis, Direction, Incidence, Model, Mueller, Side,
    lanes::{LaneKernel, Real, SimdLevel, WIDTH, dispatch},
    models::LobeSupport,
};

use super::estimate::Estimate;
use crate::{
    region::{PolarAngles, unit},
    sampling::{seen_group, sensitivity_rotation::SensitivityRotation},
};

/// Unit vectors, component by component, with weights.
pub(super) struct NodeDirections<const N: usize> {
    pub(super) v: [[f64; N]; 3],
    pub(super) weights: [f64; N],
}

impl<const N: usize> NodeDirections<N> {
    /// The direction of the pole, of no weight.
    pub(super) fn new() -> Self {
        Self { v: [[0.0; N], [0.0; N], [1.0; N]], weights: [0.0; N] }
    }

    /// One of the unit vectors.
    pub(super) fn at(&self, k: usize) -> DVec3 {
        DVec3::new(self.v[0][k], self.v[1][k], self.v[2][k])
    }
}

/// R(β)ᵀ M cos θ of one beam.
pub(super) struct Integrand<'a> {
    model: &'a Model,
    incidence: &'a Incidence,
    basis: Basis,
    /// Nothing if every direction keeps its own s and p.
    turn: Option<SensitivityRotation>,
    flip: f64,
}

impl<'a> Integrand<'a> {
    /// With sensitivities that are rotated by `turn`.
    pub(super) fn new(
        model: &'a Model,
        incidence: &'a Incidence,
        basis: Basis,
        turn: Option<SensitivityRotation>,
    ) -> Self {
        let flip = if model.common().side.to_below() { -1.0 } else { 1.0 };
        Self { model, incidence, basis, turn, flip }
    }

    /// The values at `at` times the weights; zero on and below the horizon.
    pub(super) fn values<const N: usize>(&self, at: &NodeDirections<N>, out: &mut [Mueller; N]) {
        let mut directions = [Direction::from_sin_cos((0.0, 1.0), (0.0, 1.0)); N];
        let mut turns = [[0.0; N]; 2];
        let (turn, seen) = (&self.turn, &mut directions);
        dispatch(Seeing { at, turn, directions: seen, turns: &mut turns });
        self.model.evaluate(self.incidence, &directions, self.basis, out);
        dispatch(Weighing { at, turns: &turns, flip: self.flip, out });
    }

    /// One direction: nothing is left to estimate, and nothing is turned.
    pub(super) fn one(&self, center: PolarAngles) -> Estimate {
        let direction = Direction::new(center.0, center.1);
        let mut out = [Mueller::ZERO];
        self.model.evaluate(self.incidence, &[direction], self.basis, &mut out);
        Estimate { matrix: out[0] * direction.cos, error: Mueller::ZERO, evaluations: 1 }
    }

    /// Directions in which scattered light may be concentrated, the likeliest first: of a mirror,
    /// of refraction by a smooth face, and back to the source. Models that end behind a second face
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
    pub(super) fn lobe_supports(&self) -> Vec<LobeSupport> {
        self.model.lobe_supports(self.incidence)
    }
}

/// From unit vectors to directions, and the cosines and sines by which sensitivities are turned.
struct Seeing<'a, const N: usize> {
    at: &'a NodeDirections<N>,
    turn: &'a Option<SensitivityRotation>,
    directions: &'a mut [Direction; N],
    turns: &'a mut [[f64; N]; 2],
}

impl<const N: usize> LaneKernel for Seeing<'_, N> {
    #[inline(always)]
    fn run<V: SimdLevel>(self, vectors: V) {
        let Self { at, turn, directions, turns } = self;
        const { assert!(N.is_multiple_of(WIDTH)) };
        for group in 0..N / WIDTH {
            let v = at.v.each_ref().map(|all| all.as_chunks().0[group]);
            let [x, y, z] = [vectors.load(&v[0]), vectors.load(&v[1]), vectors.load(&v[2])];
            let [cos, sin] = match turn {
                Some(turn) => turn.at([x, y, z]),
                None => [x.splat(1.0), x.splat(0.0)],
            };
            turns[0].as_chunks_mut().0[group] = vectors.store(cos);
            turns[1].as_chunks_mut().0[group] = vectors.store(sin);
            directions.as_chunks_mut().0[group] = seen_group(vectors, &v);
        }
    }
}

/// R(β)ᵀ M cos θ times the weights.
struct Weighing<'a, const N: usize> {
    at: &'a NodeDirections<N>,
    turns: &'a [[f64; N]; 2],
    flip: f64,
    out: &'a mut [Mueller; N],
}

impl<const N: usize> LaneKernel for Weighing<'_, N> {
    #[inline(always)]
    fn run<V: SimdLevel>(self, _: V) {
        let Self { at, turns: [cos, sin], flip, out } = self;
        for (k, m) in out.iter_mut().enumerate() {
            // Directions of no weight lie on the edge of the region, at worst on the horizon.
            if at.weights[k] == 0.0 {
                *m = Mueller::ZERO;
                continue;
            }
            let factor = at.weights[k] * at.v[2][k];
            let (c, s) = (cos[k] * factor, flip * sin[k] * factor);
            let [first, second, third, fourth] = m.0;
            for e in 0..4 {
                m.0[0][e] = first[e] * factor;
                m.0[1][e] = c * second[e] - s * third[e];
                m.0[2][e] = s * second[e] + c * third[e];
                m.0[3][e] = fourth[e] * factor;
            }
        }
    }
}
