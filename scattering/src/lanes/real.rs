//! Real numbers, one or a batch of lanes.

use std::{
    f64::consts::LOG2_E,
    ops::{Add, Div, Mul, Neg, Sub},
};

/// One number, or a batch of lanes with the same operations.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// The number `x`, in every lane.
    fn splat(self, x: f64) -> Self;

    /// `f` of each number.
    fn map(self, f: impl Fn(f64) -> f64) -> Self;

    /// The absolute value.
    #[inline(always)]
    fn abs(self) -> Self {
        self.map(f64::abs)
    }

    /// The square root.
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    /// The sine and the cosine.
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        (self.map(f64::sin), self.map(f64::cos))
    }

    /// `a` where this is not negative, `b` elsewhere.
    fn select(self, a: Self, b: Self) -> Self;

    /// The nearest whole number from 0 to `most`, which is whole and less than 2⁵¹; 0 for NaN.
    #[inline(always)]
    fn rounded_within(self, most: f64) -> Self {
        let from_0 = self.select(self, self.splat(0.0));
        let within = (-from_0 + most).select(from_0, self.splat(most));
        within + ROUNDING - ROUNDING
    }

    /// e^x for x ≤ 0, to 2·10⁻¹⁶ of it; 0 from −708 on, where numbers begin to lose digits.
    ///
    /// 2^k times the series of e^r, |r| ≤ ln 2/2, whose first term left out is r¹⁴/14! < 4·10⁻¹⁸.
    #[inline(always)]
    fn exp_falling(self) -> Self {
        let is_less = -self + LAST;
        let within = is_less.select(self.splat(LAST), self);
        let shifted = within * LOG2_E + ROUNDING;
        let k = shifted - ROUNDING;
        let r = within - k * LN_2[0] - k * LN_2[1];
        let sum = polynomial(&SERIES, r);
        let power = shifted.map(|x| f64::from_bits(x.to_bits().wrapping_add(1023) << 52));
        // NaN is passed on.
        is_less.select(self.splat(0.0), sum * power)
    }
}

/// e^x is 0 from here on.
const LAST: f64 = -708.0;
/// 1.5·2⁵²: what is added to it is rounded to an integer in the last bits.
const ROUNDING: f64 = 6_755_399_441_055_744.0;
/// ln 2 in two parts, the first with zeros at its end, so that k times it is exact.
const LN_2: [f64; 2] = [6.931_471_803_691_238_2e-1, 1.908_214_929_270_587_7e-10];
/// 1/13!, 1/12!, …, 1/0!.
const SERIES: [f64; 14] = [
    1.0 / 6_227_020_800.0,
    1.0 / 479_001_600.0,
    1.0 / 39_916_800.0,
    1.0 / 3_628_800.0,
    1.0 / 362_880.0,
    1.0 / 40_320.0,
    1.0 / 5_040.0,
    1.0 / 720.0,
    1.0 / 120.0,
    1.0 / 24.0,
    1.0 / 6.0,
    0.5,
    1.0,
    1.0,
];

impl Real for f64 {
    #[inline(always)]
    fn splat(self, x: f64) -> Self {
        x
    }

    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        f(self)
    }

    #[inline(always)]
    fn select(self, a: Self, b: Self) -> Self {
        if self >= 0.0 { a } else { b }
    }
}

/// Σ c_k x^{n−k} of the coefficients c_0 … c_n: odd and even powers side by side, so that half
/// of the operations wait for each other.
#[inline(always)]
pub(crate) fn polynomial<R: Real>(coefficients: &[f64], x: R) -> R {
    let square = x * x;
    let mut sums = [x.splat(0.0); 2];
    for (at, coefficient) in coefficients.iter().rev().enumerate().rev() {
        sums[at % 2] = sums[at % 2] * square + *coefficient;
    }
    sums[1] * x + sums[0]
}
