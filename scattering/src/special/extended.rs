//! Numbers of twice the digits of `f64`: the unevaluated sum of two of them, good to 10⁻³¹.
//!
//! For integrals whose leading terms cancel, where `f64` leaves no digit of the rest. Every operation
//! keeps the exact error of its leading part and rounds once more.
//!
//! T. J. Dekker, Numer. Math. 18, 224 (1971); Y. Hida, X. S. Li and D. H. Bailey, *Algorithms for
//! quad-double precision floating point arithmetic*, ARITH-15 (2001).

use std::ops::{Add, Div, Mul, Neg, Sub};

pub use self::{
    complex::{ExtendedComplex, solve},
    dot::ExtendedRow,
};

mod complex;
mod dot;

/// A real number: `high` + `low`, with |`low`| at most half a unit in the last place of `high`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extended {
    high: f64,
    low: f64,
}

/// a + b and its rounding error.
#[inline(always)]
fn sum(a: f64, b: f64) -> Extended {
    let high = a + b;
    let part = high - a;
    Extended { high, low: (a - (high - part)) + (b - part) }
}

/// a + b and its rounding error, for |a| ≥ |b|.
#[inline(always)]
fn ordered_sum(a: f64, b: f64) -> Extended {
    let high = a + b;
    Extended { high, low: b - (high - a) }
}

/// The first 26 bits of `a`, and the others.
#[inline(always)]
fn split(a: f64) -> (f64, f64) {
    let shifted = 134_217_729.0 * a;
    let first = shifted - (shifted - a);
    (first, a - first)
}

/// a b and its rounding error.
#[inline(always)]
fn product(a: f64, b: f64) -> Extended {
    let high = a * b;
    let ((a1, a2), (b1, b2)) = (split(a), split(b));
    Extended { high, low: ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2 }
}

impl Extended {
    /// 0.
    pub const ZERO: Self = Self { high: 0.0, low: 0.0 };
    /// 1.
    pub const ONE: Self = Self { high: 1.0, low: 0.0 };
    /// π.
    pub const PI: Self = Self { high: std::f64::consts::PI, low: 1.224_646_799_147_353_2e-16 };

    /// The nearest `f64`.
    #[inline(always)]
    pub fn to_f64(self) -> f64 {
        self.high
    }

    /// The absolute value.
    pub fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// The number times 2 or another power of two.
    #[inline(always)]
    pub fn times_power(self, power: f64) -> Self {
        Self { high: self.high * power, low: self.low * power }
    }

    /// The square root of a number that is not negative.
    pub fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self::ZERO;
        }
        // Each step of Newton's method doubles the digits.
        let first = Self::from(self.high.sqrt());
        let second = (first + self / first).times_power(0.5);
        (second + self / second).times_power(0.5)
    }

    /// The sine and the cosine, for |x| far below 2⁵².
    pub fn sin_cos(self) -> (Self, Self) {
        const HALF_PI: [f64; 3] =
            [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_183_3e-33];
        let quarter = (self.high / HALF_PI[0]).round();
        let r = HALF_PI.iter().fold(self, |r, &part| r - product(quarter, part));
        let (mut sin, mut cos) = (r, Self::ONE);
        let (square, mut odd, mut even) = (r * r, r, Self::ONE);
        // 0.79³⁴/34! is below 10⁻⁴².
        for k in 1..17 {
            let k = 2.0 * f64::from(k);
            even = -(even * square / Self::from((k - 1.0) * k));
            odd = -(odd * square / Self::from(k * (k + 1.0)));
            (sin, cos) = (sin + odd, cos + even);
        }
        match quarter.rem_euclid(4.0) as u8 {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }

    /// e^x for |x| < 700.
    pub fn exp(self) -> Self {
        const LN_2: [f64; 3] =
            [std::f64::consts::LN_2, 2.319_046_813_846_299_6e-17, 5.707_708_438_416_212e-34];
        let power = (self.high / LN_2[0]).round();
        let r = LN_2.iter().fold(self, |r, &part| r - product(power, part));
        let (mut total, mut term) = (Self::ONE, Self::ONE);
        // 0.35²⁶/26! is below 10⁻³⁸.
        for k in 1..26 {
            term = term * r / Self::from(f64::from(k));
            total = total + term;
        }
        total.times_power(power.exp2())
    }
}

impl From<f64> for Extended {
    #[inline(always)]
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Neg for Extended {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Add for Extended {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let (highs, lows) = (sum(self.high, other.high), sum(self.low, other.low));
        let rounded = ordered_sum(highs.high, highs.low + lows.high);
        ordered_sum(rounded.high, rounded.low + lows.low)
    }
}

impl Sub for Extended {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Extended {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let highs = product(self.high, other.high);
        ordered_sum(highs.high, highs.low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Extended {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::from(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::from(second);
        let third = rest.high / other.high;
        ordered_sum(first, second) + Self::from(third)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: Extended, b: Extended) -> bool {
        (a - b).to_f64().abs() < 1e-30
    }

    #[test]
    fn quotients_and_roots_are_undone_by_products() {
        for x in [3.0, 0.1, 1e5, 7.7e-3] {
            let x = Extended::from(x);
            let one = x * (Extended::ONE / x);
            assert!(close(one, Extended::ONE), "{one:?}");
            assert!(close(x.sqrt() * x.sqrt() / x, Extended::ONE));
        }
    }

    #[test]
    fn sines_and_exponentials_obey_their_addition_theorems() {
        for x in [0.3, 2.0, -5.5, 37.25, 171.0] {
            let x = Extended::from(x);
            let ((s, c), (s2, c2)) = (x.sin_cos(), x.times_power(2.0).sin_cos());
            assert!(close(s * s + c * c, Extended::ONE));
            assert!(close((s * c).times_power(2.0), s2) && close(c * c - s * s, c2), "{x:?}");
            assert!((s.to_f64() - x.to_f64().sin()).abs() < 1e-15);
            let (e, e2) = (x.exp(), x.times_power(2.0).exp());
            assert!(close(e * e / e2, Extended::ONE));
            assert!((e.to_f64() / x.to_f64().exp() - 1.0).abs() < 1e-13);
        }
        let (s, c) = (Extended::PI / Extended::from(6.0)).sin_cos();
        assert!(close(s, Extended::from(0.5)));
        assert!(close(c, Extended::from(0.75).sqrt()));
        // e to 31 digits, as the sum of two numbers.
        let e = Extended { high: std::f64::consts::E, low: 1.445_646_891_729_250_2e-16 };
        assert!(close(Extended::ONE.exp(), e));
    }
}
