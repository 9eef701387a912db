//! Batches of bare facets: their matrices, or the sum of them.
//!
//! The slopes of a part of the directions come first, then their densities, which every kind of
//! slopes computes in its own way, then the matrices.

use super::{
    bare::{Facet, UNTURNED_REFLECTION},
    rotation::{FacetOrientation, FacetRotation},
};
use crate::{
    Direction, Incidence, Mueller, Side,
    geometry::ScatteredRay,
    lanes::{Complex, LaneKernel, SimdLevel, WIDTH, dispatch, filled_up},
    models::{Brdf, sum_of},
    polarization::{SignedWeights, elements, muellers},
};

/// Groups of [`WIDTH`] directions whose slopes are held at a time.
const GROUPS: usize = 32;

/// The slopes of the facets that reflect a beam into directions.
struct SlopeKernel<'a> {
    incidence: &'a Incidence,
    directions: &'a [[Direction; WIDTH]],
    out: &'a mut [[[f64; WIDTH]; 2]],
}

impl LaneKernel for SlopeKernel<'_> {
    #[inline(always)]
    fn run<V: SimdLevel>(self, vectors: V) {
        for (directions, out) in self.directions.iter().zip(self.out) {
            let to = ScatteredRay::batch(vectors, directions);
            *out = FacetOrientation::between(self.incidence, &to)
                .slopes
                .map(|slope| vectors.store(slope));
        }
    }
}

/// The matrices of facets whose slopes have known densities.
struct MatrixKernel<'a> {
    facet: &'a Facet,
    incidence: &'a Incidence,
    directions: &'a [[Direction; WIDTH]],
    densities: &'a [[f64; WIDTH]],
    out: &'a mut [[Mueller; WIDTH]],
}

impl LaneKernel for MatrixKernel<'_> {
    #[inline(always)]
    fn run<V: SimdLevel>(self, vectors: V) {
        let Self { facet, incidence, .. } = self;
        for ((directions, density), out) in self.directions.iter().zip(self.densities).zip(self.out)
        {
            let batch = facet.batch(vectors, incidence, directions, density);
            muellers(vectors, batch.jones, batch.weight, out);
            if batch.is_delicate {
                for (m, direction) in out.iter_mut().zip(directions) {
                    *m = facet.mueller(incidence, direction);
                }
            }
        }
    }
}

/// The sum of such matrices, w R(β)ᵀ M, lane by lane.
struct SumKernel<'a> {
    facet: &'a Facet,
    incidence: &'a Incidence,
    directions: &'a [[Direction; WIDTH]],
    densities: &'a [[f64; WIDTH]],
    weights: SignedWeights<'a>,
    sum: &'a mut Mueller,
}

impl LaneKernel for SumKernel<'_> {
    #[inline(always)]
    fn run<V: SimdLevel>(self, vectors: V) {
        let Self { facet, incidence, directions, densities, weights, sum } = self;
        let [weight, cos2b, sin2b] =
            [weights.weight, weights.cos2b, weights.sin2b].map(|part| part.as_chunks().0);
        let zero = vectors.load(&[0.0; WIDTH]);
        let mut sums = [[zero; 4]; 4];
        for (group, (directions, density)) in directions.iter().zip(densities).enumerate() {
            let batch = facet.batch(vectors, incidence, directions, density);
            if batch.is_delicate {
                for (k, direction) in directions.iter().enumerate() {
                    weights.add(group * WIDTH + k, &facet.mueller(incidence, direction), sum);
                }
                continue;
            }
            let m = elements(batch.jones);
            let w = batch.weight * vectors.load(&weight[group]);
            let (c, s) =
                (w * vectors.load(&cos2b[group]), w * (vectors.load(&sin2b[group]) * weights.sign));
            for k in 0..4 {
                sums[0][k] = sums[0][k] + w * m[0][k];
                sums[1][k] = sums[1][k] + (c * m[1][k] - s * m[2][k]);
                sums[2][k] = sums[2][k] + (s * m[1][k] + c * m[2][k]);
                sums[3][k] = sums[3][k] + w * m[3][k];
            }
        }
        for (row, sums) in sum.0.iter_mut().zip(sums) {
            for (element, lanes) in row.iter_mut().zip(sums) {
                *element += vectors.store(lanes).into_iter().sum::<f64>();
            }
        }
    }
}

/// A batch of bare facets, lit from above.
struct FacetBatch<R> {
    /// |w|² J.
    jones: [Complex<R>; 4],
    /// Factor of its matrix M.
    weight: R,
    /// True if light hits one of them so close to its normal that it must be evaluated alone.
    is_delicate: bool,
}

impl Facet {
    /// Puts the matrices of all `directions` into `out`, which has their number.
    pub(super) fn matrices(
        &self,
        incidence: &Incidence,
        directions: &[Direction],
        out: &mut [Mueller],
    ) {
        let groups = if self.is_bare_from_above() { directions.as_chunks().0 } else { &[] };
        let done = groups.as_flattened().len();
        let (to, left) = out.split_at_mut(done);
        let to = to.as_chunks_mut().0;
        self.with_densities(incidence, groups, |first, directions, densities| {
            let out = &mut to[first..first + directions.len()];
            dispatch(MatrixKernel { facet: self, incidence, directions, densities, out });
        });
        for (m, direction) in left.iter_mut().zip(&directions[done..]) {
            *m = self.mueller(incidence, direction);
        }
    }

    /// Σ w R(β)ᵀ M over all `directions`.
    pub(super) fn sum_of_matrices(
        &self,
        incidence: &Incidence,
        directions: &[Direction],
        weights: SignedWeights<'_>,
    ) -> Mueller {
        if !self.is_bare_from_above() {
            return sum_of(directions, weights, |directions, out| {
                self.matrices(incidence, directions, out);
            });
        }
        let mut sum = Mueller::ZERO;
        let (groups, rest) = directions.as_chunks();
        self.add_groups(incidence, groups, weights, &mut sum);
        if let Some(group) = filled_up(rest) {
            let [weight, cos2b, sin2b] = weights.group(groups.as_flattened().len());
            let weights =
                SignedWeights { weight: &weight, cos2b: &cos2b, sin2b: &sin2b, ..weights };
            self.add_groups(incidence, &[group], weights, &mut sum);
        }
        sum
    }

    fn add_groups(
        &self,
        incidence: &Incidence,
        directions: &[[Direction; WIDTH]],
        weights: SignedWeights<'_>,
        sum: &mut Mueller,
    ) {
        self.with_densities(incidence, directions, |first, directions, densities| {
            let weights = weights.part(first * WIDTH..(first + directions.len()) * WIDTH);
            dispatch(SumKernel { facet: self, incidence, directions, densities, weights, sum });
        });
    }

    /// Hands the densities of the slopes that reflect into several directions to `use_them`, with
    /// the number of the first group of directions, for at most [`GROUPS`] groups at a time.
    fn with_densities(
        &self,
        incidence: &Incidence,
        directions: &[[Direction; WIDTH]],
        mut use_them: impl FnMut(usize, &[[Direction; WIDTH]], &[[f64; WIDTH]]),
    ) {
        for (part, directions) in directions.chunks(GROUPS).enumerate() {
            let mut slopes = [[[0.0; WIDTH]; 2]; GROUPS];
            let mut densities = [[0.0; WIDTH]; GROUPS];
            let slopes = &mut slopes[..directions.len()];
            let densities = &mut densities[..directions.len()];
            dispatch(SlopeKernel { incidence, directions, out: slopes });
            self.slopes.densities(slopes, densities);
            use_them(part * GROUPS, directions, densities);
        }
    }

    #[inline(always)]
    fn batch<V: SimdLevel>(
        &self,
        vectors: V,
        incidence: &Incidence,
        directions: &[Direction; WIDTH],
        density: &[f64; WIDTH],
    ) -> FacetBatch<V::Vector> {
        let to = ScatteredRay::batch(vectors, directions);
        let facet = FacetOrientation::between(incidence, &to);
        let turn = FacetRotation::new(incidence, &to, to.cos);
        let norm = turn.norm();
        let weight = facet.weight(vectors.load(density), to.cos * (4.0 * incidence.cos) * norm);
        let mut is_delicate = false;
        let (norm, sin2) = (vectors.store(norm), vectors.store(facet.sin2));
        for (norm, sin2) in norm.into_iter().zip(sin2) {
            is_delicate |=
                norm < f64::MIN_POSITIVE || (self.unturned && sin2 <= UNTURNED_REFLECTION);
        }
        let jones = turn.elements(self.films.bare(facet.cos(), facet.sin2));
        FacetBatch { jones, weight, is_delicate }
    }

    /// True if directions go through [`Facet::batch`].
    fn is_bare_from_above(&self) -> bool {
        self.common.side == Side::DownUp && self.films.is_bare()
    }
}
