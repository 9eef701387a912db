//! Elementary functions of one number or several, each by its Taylor series.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

use super::real::{Real, polynomial};

/// The hyperbolic sine and cosine of x from 0 to 700, to 9·10⁻¹⁶ of them.
#[inline(always)]
pub fn sinh_cosh<R: Real>(x: R) -> [R; 2] {
    let falling = (-x).exp_falling();
    let rising = x.splat(1.0) / falling;
    // Where the difference would cancel: the series, whose first term left out is x¹⁵/15!.
    let series = x * polynomial(&SINH, x * x);
    [(x - 0.5).select((rising - falling) * 0.5, series), (rising + falling) * 0.5]
}

/// The sine and cosine of x from 0 to π, to 3·10⁻¹⁶; the sine to 4·10⁻¹⁶ of it.
///
/// With r the distance from the nearest quarter turn, |r| ≤ π/4, the series of sin r and cos r,
/// whose first terms left out are r¹⁷/17! and r¹⁸/18!.
#[inline(always)]
pub fn sin_cos_of_half_turn<R: Real>(x: R) -> [R; 2] {
    let quarters = (x * FRAC_2_PI).rounded_within(2.0);
    let r = x - quarters * QUARTER[0] - quarters * QUARTER[1];
    let r2 = r * r;
    let (sin, cos) = (r * polynomial(&SIN, r2), polynomial(&COS, r2));
    let is_one = -(quarters - 1.0).abs() + 0.5;
    let (s, c) = (is_one.select(cos, sin), is_one.select(sin, cos));
    [(-quarters + 1.5).select(s, -s), (-quarters + 0.5).select(c, -c)]
}

/// The number nearest to π/2, and what is left of π/2.
const QUARTER: [f64; 2] = [FRAC_PI_2, 6.123_233_995_736_766e-17];
/// 1/13!, 1/11!, …, 1/1!.
const SINH: [f64; 7] = [
    1.0 / 6_227_020_800.0,
    1.0 / 39_916_800.0,
    1.0 / 362_880.0,
    1.0 / 5_040.0,
    1.0 / 120.0,
    1.0 / 6.0,
    1.0,
];
/// −1/15!, 1/13!, …, 1/1!.
const SIN: [f64; 8] = [
    -1.0 / 1_307_674_368_000.0,
    1.0 / 6_227_020_800.0,
    -1.0 / 39_916_800.0,
    1.0 / 362_880.0,
    -1.0 / 5_040.0,
    1.0 / 120.0,
    -1.0 / 6.0,
    1.0,
];
/// 1/16!, −1/14!, …, 1/0!.
const COS: [f64; 9] = [
    1.0 / 20_922_789_888_000.0,
    -1.0 / 87_178_291_200.0,
    1.0 / 479_001_600.0,
    -1.0 / 3_628_800.0,
    1.0 / 40_320.0,
    -1.0 / 720.0,
    1.0 / 24.0,
    -0.5,
    1.0,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hyperbolic_functions_are_those_of_the_standard_library() {
        for k in 0..=20_000 {
            let x = 1e-3 * f64::from(k) + 1e-6 * f64::from(k % 97);
            let [sinh, cosh] = sinh_cosh(x);
            assert!((sinh - x.sinh()).abs() <= 9e-16 * x.sinh(), "{x}: {sinh:e}");
            assert!((cosh - x.cosh()).abs() <= 9e-16 * x.cosh(), "{x}: {cosh:e}");
        }
        assert_eq!(sinh_cosh(0.0), [0.0, 1.0]);
    }

    #[test]
    fn sine_and_cosine_of_a_half_turn_are_those_of_the_standard_library() {
        for k in 0..=31_415 {
            let x = 1e-4 * f64::from(k) + 1e-7 * f64::from(k % 89);
            let [sin, cos] = sin_cos_of_half_turn(x);
            assert!((sin - x.sin()).abs() <= 4e-16 * x.sin(), "{x}: {sin:e}");
            assert!((cos - x.cos()).abs() <= 3e-16, "{x}: {cos:e}");
        }
        assert_eq!(sin_cos_of_half_turn(0.0), [0.0, 1.0]);
        assert_eq!(sin_cos_of_half_turn(1e-300)[0], 1e-300);
    }
}
