//! Gauss's rule of eight points, one group of lanes, and its error.

use scattering::lanes::{Real, WIDTH};

/// The number of nodes.
pub(super) const SIDE: usize = WIDTH;

/// Its nodes on [−1, 1], the zeros of the Legendre polynomial (M.
/// Abramowitz and I. A. Stegun, *Handbook of Mathematical Functions*, 1964, table 25.4).
pub(super) const NODE: [f64; SIDE] = [
    -0.960_289_856_497_536_232,
    -0.796_666_477_413_626_740,
    -0.525_532_409_916_328_986,
    -0.183_434_642_495_649_805,
    0.183_434_642_495_649_805,
    0.525_532_409_916_328_986,
    0.796_666_477_413_626_740,
    0.960_289_856_497_536_232,
];

/// Its weights.
pub(super) const WEIGHT: [f64; SIDE] = [
    0.101_228_536_290_376_259,
    0.222_381_034_453_374_471,
    0.313_706_645_877_887_287,
    0.362_683_783_378_361_983,
    0.362_683_783_378_361_983,
    0.313_706_645_877_887_287,
    0.222_381_034_453_374_471,
    0.101_228_536_290_376_259,
];

/// Matrix from the coefficients 1 to 7 of a series of Legendre polynomials to the values at the
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

/// The sum of values at the nodes with these weights.
#[inline(always)]
pub(super) fn weighted<R: Real>(values: &[R; SIDE], weights: &[f64; SIDE]) -> R {
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
/// the later ones are not smaller (J. Berntsen and T. O. Espelid, *Error estimation in automatic
/// quadrature routines*, ACM Trans. Math. Softw. 17, 233–252 (1991)). The error is never less than
/// the rounding of a sum of this size.
#[inline(always)]
pub(super) fn error<R: Real>(values: &[R; SIDE]) -> R {
    let mut pairs = [values[0].splat(0.0); 3];
    for (two, pair) in COEFFICIENTS[1..].as_chunks::<2>().0.iter().zip(&mut pairs) {
        *pair = weighted(values, &two[0]).abs() + weighted(values, &two[1]).abs();
    }
    let [first, second, third] = pairs;
    let before = second / (first + f64::MIN_POSITIVE) * LASTING;
    let last = third / (second + f64::MIN_POSITIVE);
    let ratio = (last - before).select(last, before) / SLOW;
    let fall = (ratio - MOST).select(ratio.splat(MOST), ratio);
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

/// Largest apparent ratio of successive coefficients; beyond that the ratio is not used.
const MOST: f64 = 1.5;

/// Largest ratio of the error of a slowly decreasing series to its last coefficients.
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
    fn a_last_pair_after_nothing_is_no_smaller_than_its_error() {
        // The seventh Legendre polynomial: all other coefficients are rounding.
        let legendre = |x: f64| {
            let y = x * x;
            x * (((429.0 * y - 693.0) * y + 315.0) * y - 35.0) / 16.0
        };
        let error = error(&NODE.map(legendre));
        assert!(error.is_finite() && error > 1.0, "{error:e}");
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
}
