//! One rectangle of the adaptive subdivision, and its pair of rules.

use glam::DVec3;
use scattering::{
    Mueller,
    lanes::{Batch, Real, Vectors, WIDTH, with_widest},
};

use super::{
    Measured,
    integrand::Integrand,
    rays::{Ray, Rays},
};

/// A rectangle [s₀, s₁] × [u₀, u₁] of the unit square of one interval of one slice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cell {
    pub(super) slice: usize,
    pub(super) interval: usize,
    pub(super) s: (f64, f64),
    pub(super) u: (f64, f64),
}

/// Nodes of a rule along one side.
const SIDE: usize = 7;

/// Evaluations of a cell.
pub(super) const NODES: usize = SIDE * SIDE;

/// Nodes of the seven-point Kronrod rule on [−1, 1]; every second one belongs to the three-point
/// Gauss rule (A. S. Kronrod, *Nodes and weights of quadrature formulas*, 1965).
const NODE: [f64; SIDE] = [
    -0.960_491_268_708_020_283,
    -0.774_596_669_241_483_377,
    -0.434_243_749_346_802_558,
    0.0,
    0.434_243_749_346_802_558,
    0.774_596_669_241_483_377,
    0.960_491_268_708_020_283,
];

/// The rays on which the nodes of a cell lie.
pub(super) type Fan = [Ray; SIDE];

/// Weights of the Kronrod rule.
const KRONROD: [f64; SIDE] = [
    0.104_656_226_026_467_265,
    0.268_488_089_868_333_440,
    0.401_397_414_775_962_222,
    0.450_916_538_658_474_142,
    0.401_397_414_775_962_222,
    0.268_488_089_868_333_440,
    0.104_656_226_026_467_265,
];

/// Weights of the Gauss rule.
const GAUSS: [f64; SIDE] = [0.0, 5.0 / 9.0, 0.0, 8.0 / 9.0, 0.0, 5.0 / 9.0, 0.0];

impl Cell {
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

    /// Whether its nodes lie on the same rays as those of `other`.
    pub(super) fn shares_rays(&self, other: &Self) -> bool {
        (self.slice, self.interval, self.s) == (other.slice, other.interval, other.s)
    }

    /// The rays on which its nodes lie.
    pub(super) fn fan(&self, rays: &Rays) -> Fan {
        let (s, ds) = half(self.s);
        NODE.map(|node| rays.ray(self.slice, self.interval, s + ds * node))
    }

    /// The integral over the cell with its error.
    pub(super) fn measure(self, fan: &Fan, integrand: &Integrand<'_>) -> Measured {
        let (at, jacobian) = self.nodes(fan);
        let mut values = [Mueller::ZERO; NODES];
        integrand.values(&at, &mut values);
        for (value, factor) in values.iter_mut().zip(jacobian) {
            // Directions of no weight lie on the edge of the region, at worst on the horizon.
            if factor == 0.0 {
                *value = Mueller::ZERO;
            } else {
                *value *= factor;
            }
        }
        judge(self, &values)
    }

    /// The directions of the nodes on their rays, and the solid angle per area of [−1, 1]².
    pub(super) fn nodes(&self, fan: &Fan) -> ([DVec3; NODES], [f64; NODES]) {
        let (mut at, mut jacobian) = ([DVec3::Z; NODES], [0.0; NODES]);
        with_widest(Placing { cell: self, fan, at: &mut at, jacobian: &mut jacobian });
        (at, jacobian)
    }
}

/// The placing of nodes, ray by ray.
struct Placing<'a> {
    cell: &'a Cell,
    fan: &'a Fan,
    at: &'a mut [DVec3; NODES],
    jacobian: &'a mut [f64; NODES],
}

impl Batch for Placing<'_> {
    #[inline(always)]
    fn run<V: Vectors>(self, vectors: V) {
        let Self { cell, fan, at, jacobian } = self;
        let ((_, ds), (u, du)) = (half(cell.s), half(cell.u));
        // What fills up the vector means nothing.
        let mut nodes = [0.0; WIDTH];
        nodes[..SIDE].copy_from_slice(&NODE);
        let nodes = vectors.load(&nodes) * du + u;
        for (i, ray) in fan.iter().enumerate() {
            let (v, per_area) = ray.at(nodes);
            let [x, y, z] = [vectors.store(v[0]), vectors.store(v[1]), vectors.store(v[2])];
            let weights = vectors.store(per_area * (ds * du));
            for j in 0..SIDE {
                at[SIDE * i + j] = DVec3::new(x[j], y[j], z[j]);
                jacobian[SIDE * i + j] = weights[j];
            }
        }
    }
}

/// The middle of an interval and half its length.
fn half((from, to): (f64, f64)) -> (f64, f64) {
    (0.5 * (from + to), 0.5 * (to - from))
}

/// Integral and error from the values at the nodes, p slow and t fast.
fn judge(cell: Cell, values: &[Mueller; NODES]) -> Measured {
    let mut sums = Sums::default();
    with_widest(Summing { values, sums: &mut sums });
    let Sums { best, gauss_p, gauss_t, spread } = sums;
    let mut error = Mueller::ZERO;
    let (mut worst_p, mut worst_t) = (0.0_f64, 0.0_f64);
    for row in 0..4 {
        for column in 0..4 {
            let of = |m: &Mueller| m.0[row][column];
            let (p, t) = ((of(&gauss_p) - of(&best)).abs(), (of(&gauss_t) - of(&best)).abs());
            error.0[row][column] = sharpened(p, of(&spread)) + sharpened(t, of(&spread));
            (worst_p, worst_t) = (worst_p.max(p), worst_t.max(t));
        }
    }
    Measured { cell, matrix: best, error, along_p: worst_p > worst_t }
}

/// What the rules make of the values of a cell.
#[derive(Default)]
struct Sums {
    /// Kronrod's rule along both sides.
    best: Mueller,
    /// Gauss's rule along p.
    gauss_p: Mueller,
    /// Gauss's rule along t.
    gauss_t: Mueller,
    /// The integral of the distance from the mean value.
    spread: Mueller,
}

/// The sums, several elements at a time.
struct Summing<'a> {
    values: &'a [Mueller; NODES],
    sums: &'a mut Sums,
}

impl Batch for Summing<'_> {
    #[inline(always)]
    fn run<V: Vectors>(self, vectors: V) {
        let Self { values, sums } = self;
        let zero = vectors.load(&[0.0; WIDTH]);
        for part in 0..16 / WIDTH {
            let [mut best, mut gauss_p, mut gauss_t, mut spread] = [zero; 4];
            for (i, row) in values.chunks_exact(SIDE).enumerate() {
                let [mut kronrod, mut gauss] = [zero; 2];
                for (j, value) in row.iter().enumerate() {
                    let value = vectors.load(&value.0.as_flattened().as_chunks().0[part]);
                    kronrod = kronrod + value * KRONROD[j];
                    gauss = gauss + value * GAUSS[j];
                }
                best = best + kronrod * KRONROD[i];
                gauss_p = gauss_p + kronrod * GAUSS[i];
                gauss_t = gauss_t + gauss * KRONROD[i];
            }
            let mean = best * 0.25;
            for (k, value) in values.iter().enumerate() {
                let value = vectors.load(&value.0.as_flattened().as_chunks().0[part]);
                spread = spread + (value - mean).abs() * (KRONROD[k / SIDE] * KRONROD[k % SIDE]);
            }
            let all = [
                (&mut sums.best, best),
                (&mut sums.gauss_p, gauss_p),
                (&mut sums.gauss_t, gauss_t),
                (&mut sums.spread, spread),
            ];
            for (sum, numbers) in all {
                sum.0.as_flattened_mut().as_chunks_mut().0[part] = vectors.store(numbers);
            }
        }
    }
}

/// The error of the better rule from the disagreement of the two.
///
/// The Gauss rule is of degree 5 and the Kronrod rule of degree 11, so for smooth functions the
/// error of the latter falls with the square of the disagreement. The power 3/2, as in QUADPACK,
/// also covers cells with the square roots that are left where a region ends on the horizon. It
/// is never less than the rounding of a sum of this size.
fn sharpened(disagreement: f64, spread: f64) -> f64 {
    if spread == 0.0 {
        return disagreement;
    }
    let ratio = disagreement / spread;
    disagreement * (SAFETY * ratio).sqrt().min(1.0) + f64::EPSILON * spread
}

/// Disagreements of more than a SAFETYth of the spread are taken as they are.
const SAFETY: f64 = 200.0;

#[cfg(test)]
mod tests {
    use super::*;

    fn power(rule: &[f64; SIDE], n: i32) -> f64 {
        (0..SIDE).map(|k| rule[k] * NODE[k].powi(n)).sum()
    }

    #[test]
    fn the_rules_are_exact_up_to_their_degrees() {
        for n in 0..=11 {
            let exact = if n % 2 == 0 { 2.0 / f64::from(n + 1) } else { 0.0 };
            assert!((power(&KRONROD, n) - exact).abs() < 1e-15, "degree {n}");
            assert!(n > 5 || (power(&GAUSS, n) - exact).abs() < 1e-15, "degree {n}");
        }
        assert!((power(&KRONROD, 12) - 2.0 / 13.0).abs() > 1e-6);
    }

    #[test]
    fn halves_cover_the_cell() {
        let cell = Cell { slice: 0, interval: 1, s: (0.0, 1.0), u: (0.5, 1.0) };
        let [left, right] = cell.halves(true);
        assert_eq!((left.s, right.s, left.u), ((0.0, 0.5), (0.5, 1.0), cell.u));
        let [low, high] = cell.halves(false);
        assert_eq!((low.u, high.u, low.s), ((0.5, 0.75), (0.75, 1.0), cell.s));
    }
}
