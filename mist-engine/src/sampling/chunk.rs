//! Directions in the form that models and sums take, made of unit vectors.

use glam::DVec3;
use scattering::{
    Direction, Mueller,
    lanes::{Batch, Real, Vectors, WIDTH, with_widest},
};

use super::{points::Points, turn::Turn};

/// A part of a layout, in the order of evaluation.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chunk {
    pub(crate) directions: Vec<Direction>,
    pub(crate) weights: Vec<Weight>,
}

/// What belongs to one direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weight {
    /// Weight of the sampling times cos θ.
    pub(crate) weight: f64,
    /// cos 2β, β the turn of the sensitivity towards the centre of polarization.
    pub(crate) cos2b: f64,
    /// sin 2β, to be negated for light that leaves downwards.
    pub(crate) sin2b: f64,
}

impl Weight {
    /// Adds w R(β)ᵀ M: S(β) = R S, so rows 1 and 2 of M are turned the other way.
    pub(crate) fn add_turned(&self, m: &Mueller, flip: f64, sum: &mut Mueller) {
        let w = self.weight;
        let (c, s) = (w * self.cos2b, w * flip * self.sin2b);
        let sum = &mut sum.0;
        for k in 0..4 {
            sum[0][k] += w * m.0[0][k];
            sum[1][k] += c * m.0[1][k] - s * m.0[2][k];
            sum[2][k] += s * m.0[1][k] + c * m.0[2][k];
            sum[3][k] += w * m.0[3][k];
        }
    }
}

impl Chunk {
    /// One direction whose sensitivity is not turned.
    pub(super) fn one(direction: Direction) -> Self {
        let weight = Weight { weight: direction.cos, cos2b: 1.0, sin2b: 0.0 };
        Self { directions: vec![direction], weights: vec![weight] }
    }

    /// The directions of points above the horizon.
    pub(super) fn of(points: &Points, turn: &Turn) -> Self {
        let count = points.count();
        let mut chunk =
            Self { directions: Vec::with_capacity(count), weights: Vec::with_capacity(count) };
        with_widest(Filling { chunk: &mut chunk, points, turn });
        chunk
    }
}

/// The making of a chunk.
struct Filling<'a> {
    chunk: &'a mut Chunk,
    points: &'a Points,
    turn: &'a Turn,
}

impl Batch for Filling<'_> {
    #[inline(always)]
    fn run<V: Vectors>(self, vectors: V) {
        let mut left = self.points.count();
        for ([x, y, z], weight) in self.points.groups() {
            let v = [vectors.load(&x), vectors.load(&y), vectors.load(&z)];
            let [sin, across, sin_phi, cos_phi] = sines(v);
            let (sin, across) = (vectors.store(sin), vectors.store(across));
            let (sin_phi, cos_phi) = (vectors.store(sin_phi), vectors.store(cos_phi));
            let [cos2b, sin2b] = self.turn.at(v);
            let (cos2b, sin2b) = (vectors.store(cos2b), vectors.store(sin2b));
            for k in 0..left.min(WIDTH) {
                self.chunk.directions.push(if across[k] > 0.0 {
                    Direction::from_sin_cos((sin[k], z[k]), (sin_phi[k], cos_phi[k]))
                } else {
                    seen(DVec3::new(x[k], y[k], z[k]))
                });
                let (weight, cos2b, sin2b) = (weight[k], cos2b[k], sin2b[k]);
                self.chunk.weights.push(Weight { weight, cos2b, sin2b });
            }
            left -= left.min(WIDTH);
        }
    }
}

/// sin θ, its value without z, sin φ and cos φ of unit vectors.
#[inline(always)]
fn sines<R: Real>([x, y, z]: [R; 3]) -> [R; 4] {
    let square = (-z + 1.0) * (z + 1.0);
    let across = (x * x + y * y).sqrt();
    [square.choose(square, z.all(0.0)).sqrt(), across, y / across, x / across]
}

/// The direction of the unit vector `v` above the horizon.
pub(super) fn seen(v: DVec3) -> Direction {
    let [sin, across, sin_phi, cos_phi] = sines(v.to_array());
    // The normal has the azimuth that the signs of its zeros give it.
    let azimuth = if across > 0.0 { (sin_phi, cos_phi) } else { v.y.atan2(v.x).sin_cos() };
    Direction::from_sin_cos((sin, v.z), azimuth)
}
