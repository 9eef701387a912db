//! One rectangle of the adaptive subdivision, and what the rule makes of it.

use scattering::{
    Mueller,
    lanes::{LaneKernel, SimdLevel, WIDTH, dispatch},
};

use super::{
    gauss::{NODE, SIDE, WEIGHT, error, weighted},
    integrand::{Integrand, NodeDirections},
    rays::{PolarRay, Rays},
};

/// A rectangle [s₀, s₁] × [u₀, u₁] of the unit square of one interval of one slice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CubatureCell {
    pub(super) slice: usize,
    pub(super) interval: usize,
    pub(super) s: (f64, f64),
    pub(super) u: (f64, f64),
}

/// A cell with its part of the integral.
pub(super) struct MeasuredCell {
    pub(super) cell: CubatureCell,
    pub(super) matrix: Mueller,
    pub(super) error: Mueller,
    /// True if the error along p is larger than that along t.
    pub(super) along_p: bool,
}

/// Evaluations of a cell.
pub(super) const NODES: usize = SIDE * SIDE;

/// The rays on which the nodes of a cell lie.
pub(super) type Fan = [PolarRay; SIDE];

impl CubatureCell {
    /// The halves, across p or across t.
    pub(super) fn halves(self, along_p: bool) -> [Self; 2] {
        if along_p {
            let middle = 0.5 * (self.s.0 + self.s.1);
            return [
                Self { s: (self.s.0, middle), ..self },
                Self { s: (middle, self.s.1), ..self },
            ];
        }
        let middle = 0.5 * (self.u.0 + self.u.1);
        [Self { u: (self.u.0, middle), ..self }, Self { u: (middle, self.u.1), ..self }]
    }

    /// True if its nodes lie on the same rays as those of `other`.
    pub(super) fn shares_rays(&self, other: &Self) -> bool {
        (self.slice, self.interval, self.s) == (other.slice, other.interval, other.s)
    }

    /// The rays on which its nodes lie.
    pub(super) fn fan(&self, rays: &Rays) -> Fan {
        let (s, ds) = half(self.s);
        NODE.map(|node| rays.ray(self.slice, self.interval, s + ds * node))
    }

    /// The integral over the cell with its error.
    pub(super) fn measure(self, fan: &Fan, integrand: &Integrand<'_>) -> MeasuredCell {
        let mut values = [Mueller::ZERO; NODES];
        integrand.values(&self.nodes(fan), &mut values);
        judge(self, &values)
    }

    /// The directions of the nodes on their rays, with the solid angle per area of [−1, 1]².
    pub(super) fn nodes(&self, fan: &Fan) -> NodeDirections<NODES> {
        let mut at = NodeDirections::new();
        dispatch(Placing { cell: self, fan, at: &mut at });
        at
    }
}

/// The placing of nodes, ray by ray.
struct Placing<'a> {
    cell: &'a CubatureCell,
    fan: &'a Fan,
    at: &'a mut NodeDirections<NODES>,
}

impl LaneKernel for Placing<'_> {
    #[inline(always)]
    fn run<V: SimdLevel>(self, vectors: V) {
        let Self { cell, fan, at: NodeDirections { v, weights } } = self;
        let ((_, ds), (u, du)) = (half(cell.s), half(cell.u));
        let nodes = vectors.load(&NODE) * du + u;
        for (i, ray) in fan.iter().enumerate() {
            let (direction, per_area) = ray.at(nodes);
            for (all, part) in v.iter_mut().zip(direction) {
                all.as_chunks_mut().0[i] = vectors.store(part);
            }
            weights.as_chunks_mut().0[i] = vectors.store(per_area * (ds * du));
        }
    }
}

/// The middle of an interval and half its length.
fn half((from, to): (f64, f64)) -> (f64, f64) {
    (0.5 * (from + to), 0.5 * (to - from))
}

/// Integral and error from the values at the nodes, p slow and t fast.
fn judge(cell: CubatureCell, values: &[Mueller; NODES]) -> MeasuredCell {
    let mut sums = RuleSums::default();
    dispatch(Summing { values, sums: &mut sums });
    let RuleSums { matrix, along_p, along_t } = sums;
    let along = (along_p.largest(), along_t.largest());
    MeasuredCell { cell, matrix, error: along_p + along_t, along_p: along.0 > along.1 }
}

/// Estimate of the rule from the values of a cell.
#[derive(Default)]
struct RuleSums {
    matrix: Mueller,
    /// The error of the sum along p of the sums along t.
    along_p: Mueller,
    /// The error of the sum along t of the sums along p.
    along_t: Mueller,
}

/// The sums, several elements at a time.
struct Summing<'a> {
    values: &'a [Mueller; NODES],
    sums: &'a mut RuleSums,
}

impl LaneKernel for Summing<'_> {
    #[inline(always)]
    fn run<V: SimdLevel>(self, vectors: V) {
        let Self { values, sums } = self;
        let zero = vectors.load(&[0.0; WIDTH]);
        for part in 0..16 / WIDTH {
            let (mut of_p, mut of_t) = ([zero; SIDE], [zero; SIDE]);
            for (i, row) in values.chunks_exact(SIDE).enumerate() {
                for (j, value) in row.iter().enumerate() {
                    let value = vectors.load(&value.0.as_flattened().as_chunks().0[part]);
                    of_p[i] = of_p[i] + value * WEIGHT[j];
                    of_t[j] = of_t[j] + value * WEIGHT[i];
                }
            }
            let all = [
                (&mut sums.matrix, weighted(&of_p, &WEIGHT)),
                (&mut sums.along_p, error(&of_p)),
                (&mut sums.along_t, error(&of_t)),
            ];
            for (sum, numbers) in all {
                sum.0.as_flattened_mut().as_chunks_mut().0[part] = vectors.store(numbers);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_cover_the_cell() {
        let cell = CubatureCell { slice: 0, interval: 1, s: (0.0, 1.0), u: (0.5, 1.0) };
        let [left, right] = cell.halves(true);
        assert_eq!((left.s, right.s, left.u), ((0.0, 0.5), (0.5, 1.0), cell.u));
        let [low, high] = cell.halves(false);
        assert_eq!((low.u, high.u, low.s), ((0.5, 0.75), (0.75, 1.0), cell.s));
    }
}
