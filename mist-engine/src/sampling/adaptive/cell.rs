//! One rectangle of the adaptive subdivision, and its pair of rules.

use scattering::{
    Mueller,
    lanes::{Batch, Real, Vectors, WIDTH, with_widest},
};

use super::{
    Measured,
    integrand::{Integrand, Places},
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
const SIDE: usize = WIDTH;

/// Evaluations of a cell.
pub(super) const NODES: usize = SIDE * SIDE;

/// Nodes of Gauss's rule of eight points on [−1, 1], the zeros of the Legendre polynomial (M.
/// Abramowitz and I. A. Stegun, *Handbook of Mathematical Functions*, 1964, table 25.4).
const NODE: [f64; SIDE] = [
    -0.960_289_856_497_536_232,
    -0.796_666_477_413_626_740,
    -0.525_532_409_916_328_986,
    -0.183_434_642_495_649_805,
    0.183_434_642_495_649_805,
    0.525_532_409_916_328_986,
    0.796_666_477_413_626_740,
    0.960_289_856_497_536_232,
];

/// The rays on which the nodes of a cell lie.
pub(super) type Fan = [Ray; SIDE];

/// Weights of the rule.
const WEIGHT: [f64; SIDE] = [
    0.101_228_536_290_376_259,
    0.222_381_034_453_374_471,
    0.313_706_645_877_887_287,
    0.362_683_783_378_361_983,
    0.362_683_783_378_361_983,
    0.313_706_645_877_887_287,
    0.222_381_034_453_374_471,
    0.101_228_536_290_376_259,
];

/// What takes the coefficients 1 to 7 of a series of Legendre polynomials out of the values at the
/// nodes: (2n + 1)/2 · weight · P(node).
const COEFFICIENTS: [[f64; SIDE]; SIDE - 1] = coefficients();

const fn coefficients() -> [[f64; SIDE]; SIDE - 1] {
    let mut all = [[0.0; SIDE]; SIDE - 1];
    let mut k = 0;
    while k < SIDE {
        let (mut before, mut now) = (1.0, NODE[k]);
        let mut n = 1;
        while n < SIDE {
            let degree = n as f64;
            all[n - 1][k] = (degree + 0.5) * WEIGHT[k] * now;
            let next = ((2.0 * degree + 1.0) * NODE[k] * now - degree * before) / (degree + 1.0);
            (before, now) = (now, next);
            n += 1;
        }
        k += 1;
    }
    all
}

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
        let mut values = [Mueller::ZERO; NODES];
        integrand.values(&self.nodes(fan), &mut values);
        judge(self, &values)
    }

    /// The directions of the nodes on their rays, with the solid angle per area of [−1, 1]².
    pub(super) fn nodes(&self, fan: &Fan) -> Places<NODES> {
        let mut at = Places::new();
        with_widest(Placing { cell: self, fan, at: &mut at });
        at
    }
}

/// The placing of nodes, ray by ray.
struct Placing<'a> {
    cell: &'a Cell,
    fan: &'a Fan,
    at: &'a mut Places<NODES>,
}

impl Batch for Placing<'_> {
    #[inline(always)]
    fn run<V: Vectors>(self, vectors: V) {
        let Self { cell, fan, at: Places { v, weights } } = self;
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
fn judge(cell: Cell, values: &[Mueller; NODES]) -> Measured {
    let mut sums = Sums::default();
    with_widest(Summing { values, sums: &mut sums });
    let Sums { matrix, along_p, along_t } = sums;
    let along = (along_p.largest(), along_t.largest());
    Measured { cell, matrix, error: along_p + along_t, along_p: along.0 > along.1 }
}

/// What the rule makes of the values of a cell.
#[derive(Default)]
struct Sums {
    matrix: Mueller,
    /// The error of the sum along p of the sums along t.
    along_p: Mueller,
    /// The error of the sum along t of the sums along p.
    along_t: Mueller,
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

/// The sum of values at the nodes with these weights.
#[inline(always)]
fn weighted<R: Real>(values: &[R; SIDE], weights: &[f64; SIDE]) -> R {
    let mut sum = values[0] * weights[0];
    for k in 1..SIDE {
        sum = sum + values[k] * weights[k];
    }
    sum
}

/// The error of the rule for a function with these values at the nodes.
///
/// The rule is wrong by the 16th and later coefficients of the function. How large those are, the
/// first seven tell: where they fall fast from one pair to the next, they go on falling, by the
/// fourth power of the ratio of two pairs; where they fall slowly, as for kinks and square roots,
/// the later ones are no smaller (J. Berntsen and T. O. Espelid, *Error estimation in automatic
/// quadrature routines*, ACM Trans. Math. Softw. 17, 233–252 (1991)). The error is never less than
/// the rounding of a sum of this size.
#[inline(always)]
fn error<R: Real>(values: &[R; SIDE]) -> R {
    let mut pairs = [values[0] * 0.0; 3];
    for (two, pair) in COEFFICIENTS[1..].as_chunks::<2>().0.iter().zip(&mut pairs) {
        *pair = weighted(values, &two[0]).abs() + weighted(values, &two[1]).abs();
    }
    let [first, second, third] = pairs;
    let before = second / (first + f64::MIN_POSITIVE) * LASTING;
    let last = third / (second + f64::MIN_POSITIVE);
    let ratio = (last - before).choose(last, before) / SLOW;
    let fall = (ratio - MOST).choose(ratio * 0.0 + MOST, ratio);
    let square = fall * fall;
    let mut size = values[0].abs() * WEIGHT[0];
    for k in 1..SIDE {
        size = size + values[k].abs() * WEIGHT[k];
    }
    third * (square * square) * SAFETY + size * f64::EPSILON
}

// The numbers below were tried on random lobes and apertures (`tests/adaptive/random.rs`).

/// The part of the fall from the first pair to the second that the later falls have at least:
/// chance can make the last pair small.
const LASTING: f64 = 0.5;

/// The ratio of two pairs from which on coefficients fall slowly.
const SLOW: f64 = 0.35;

/// How much more slowly they may seem to fall; beyond that the ratio says nothing.
const MOST: f64 = 1.5;

/// How much larger than the last coefficients the error of a slowly falling series may be.
const SAFETY: f64 = 4.0;

#[cfg(test)]
mod tests {
    use super::*;

    fn power(rule: &[f64; SIDE], n: i32) -> f64 {
        (0..SIDE).map(|k| rule[k] * NODE[k].powi(n)).sum()
    }

    #[test]
    fn the_rule_is_exact_up_to_degree_15() {
        for n in 0..=15 {
            let exact = if n % 2 == 0 { 2.0 / f64::from(n + 1) } else { 0.0 };
            assert!((power(&WEIGHT, n) - exact).abs() < 1e-15, "degree {n}");
        }
        assert!((power(&WEIGHT, 16) - 2.0 / 17.0).abs() > 1e-6);
    }

    #[test]
    fn a_coefficient_is_blind_to_all_lower_powers() {
        for (k, coefficient) in COEFFICIENTS.iter().enumerate() {
            for n in 0..=k as i32 {
                assert!(power(coefficient, n).abs() < 1e-14, "coefficient {} of x^{n}", k + 1);
            }
            assert!(power(coefficient, k as i32 + 1) > 0.01);
        }
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
