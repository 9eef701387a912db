//! Directions in the form that models and sums take, made of unit vectors.

use scattering::{
    Direction,
    lanes::{LaneKernel, Real, SimdLevel, WIDTH, dispatch},
    polarization::DirectionWeights,
};

use super::{lifting::Lifted, points::PlanePoints, sensitivity_rotation::SensitivityRotation};

/// A part of a layout, in the order of evaluation.
#[derive(Clone, Debug, Default)]
pub(crate) struct DirectionChunk {
    pub(crate) directions: Vec<Direction>,
    /// Weights of the sampling times cos θ, turned towards the centre of polarization.
    pub(crate) weights: DirectionWeights,
}

/// Memory for the making of chunks, to be used again.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    pub(super) points: PlanePoints,
    pub(super) lifted: Lifted,
    pub(super) chunk: DirectionChunk,
}

impl DirectionChunk {
    /// Becomes one direction whose sensitivity is not turned, or none.
    pub(super) fn fill_with_one(&mut self, direction: Option<Direction>) {
        self.directions.clear();
        self.weights.resize(0);
        if let Some(direction) = direction {
            self.directions.push(direction);
            self.weights.push(direction.cos, [1.0, 0.0]);
        }
    }

    /// Becomes the directions of unit vectors above the horizon.
    pub(super) fn fill(&mut self, lifted: &Lifted, turn: &SensitivityRotation) {
        self.directions.clear();
        let whole = lifted.count().next_multiple_of(WIDTH);
        self.directions.reserve(whole);
        self.weights.resize(whole);
        dispatch(Filling { chunk: self, lifted, turn });
        self.directions.truncate(lifted.count());
        self.weights.resize(lifted.count());
    }
}

/// The filling of a chunk, which has room.
struct Filling<'a> {
    chunk: &'a mut DirectionChunk,
    lifted: &'a Lifted,
    turn: &'a SensitivityRotation,
}

impl LaneKernel for Filling<'_> {
    #[inline(always)]
    fn run<V: SimdLevel>(self, vectors: V) {
        let Self { chunk: DirectionChunk { directions, weights }, lifted, turn } = self;
        let DirectionWeights { weight, cos2b, sin2b } = weights;
        let turns = cos2b.as_chunks_mut().0.iter_mut().zip(sin2b.as_chunks_mut().0);
        let weights = weight.as_chunks_mut().0.iter_mut().zip(turns);
        for ((v, from), (weight, (cos2b, sin2b))) in lifted.groups().zip(weights) {
            let v = v.map(|part| *part);
            let turned = turn.at(v.map(|part| vectors.load(&part)));
            *weight = *from;
            *cos2b = vectors.store(turned[0]);
            *sin2b = vectors.store(turned[1]);
            directions.extend_from_slice(&seen_group(vectors, &v));
        }
    }
}

/// The directions of several unit vectors above the horizon.
#[inline(always)]
pub(super) fn seen_group<V: SimdLevel>(vectors: V, v: &[[f64; WIDTH]; 3]) -> [Direction; WIDTH] {
    let [x, y, z] = v;
    let [sin, across, sin_phi, cos_phi] =
        sines([vectors.load(x), vectors.load(y), vectors.load(z)]);
    let (sin, across) = (vectors.store(sin), vectors.store(across));
    let (sin_phi, cos_phi) = (vectors.store(sin_phi), vectors.store(cos_phi));
    let mut group = [Direction::from_sin_cos((0.0, 1.0), (0.0, 1.0)); WIDTH];
    for (k, direction) in group.iter_mut().enumerate() {
        let azimuth =
            if across[k] > 0.0 { (sin_phi[k], cos_phi[k]) } else { of_the_normal(x[k], y[k]) };
        *direction = Direction::from_sin_cos((sin[k], z[k]), azimuth);
    }
    group
}

/// The sine and the cosine of the azimuth that the signs of its zeros give the normal.
#[cold]
#[inline(never)]
fn of_the_normal(x: f64, y: f64) -> (f64, f64) {
    y.atan2(x).sin_cos()
}

/// sin θ, its value without z, sin φ and cos φ of unit vectors.
#[inline(always)]
fn sines<R: Real>([x, y, z]: [R; 3]) -> [R; 4] {
    let square = (-z + 1.0) * (z + 1.0);
    let across = (x * x + y * y).sqrt();
    let per_across = z.splat(1.0) / across;
    [square.select(square, z.splat(0.0)).sqrt(), across, y * per_across, x * per_across]
}
