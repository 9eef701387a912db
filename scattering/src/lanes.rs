//! Several numbers at once: closed forms for a batch of directions.
//!
//! A formula is written once over [`Real`] and works on one number or, in a [`LaneKernel`], on several.
//! Each lane goes through the operations of one number in their order, so a batch has the bits of
//! its directions one by one, on every machine.

mod elementary;
mod wide;

use std::{
    f64::consts::LOG2_E,
    ops::{Add, Div, Mul, Neg, Sub},
};

pub(crate) use elementary::polynomial;
pub use elementary::{sin_cos_of_half_turn, sinh_cosh};
use num_complex::Complex64;
pub use wide::{LaneKernel, SimdLevel, dispatch};

/// Number of lanes.
pub const WIDTH: usize = 8;

/// The group of `rest`, fewer than [`WIDTH`], and the last of them again; nothing of nothing.
pub(crate) fn filled_up<T: Copy>(rest: &[T]) -> Option<[T; WIDTH]> {
    let last = rest.len().checked_sub(1)?;
    Some(std::array::from_fn(|k| rest[k.min(last)]))
}

/// One number, or several that go the same way.
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

/// [`WIDTH`] numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lanes(pub(crate) [f64; WIDTH]);

impl Lanes {
    /// The number `x` in every lane.
    pub(crate) const fn new(x: f64) -> Self {
        Self([x; WIDTH])
    }
}

impl Real for Lanes {
    #[inline(always)]
    fn splat(self, x: f64) -> Self {
        Self::new(x)
    }

    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut all = self.0;
        for x in &mut all {
            *x = f(*x);
        }
        Self(all)
    }

    #[inline(always)]
    fn select(self, a: Self, b: Self) -> Self {
        let mut all = b;
        for k in 0..WIDTH {
            all.0[k] = self.0[k].select(a.0[k], b.0[k]);
        }
        all
    }
}

impl Neg for Lanes {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|x| -x)
    }
}

macro_rules! arithmetic {
    ($($operation:ident $function:ident)*) => {$(
        impl $operation for Lanes {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                let mut all = self.0;
                for (x, y) in all.iter_mut().zip(other.0) {
                    *x = x.$function(y);
                }
                Self(all)
            }
        }

        impl $operation<f64> for Lanes {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: f64) -> Self {
                self.map(|x| x.$function(other))
            }
        }
    )*};
}

arithmetic!(Add add Sub sub Mul mul Div div);

/// A complex number, or several.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Complex<R> {
    pub(crate) re: R,
    pub(crate) im: R,
}

impl<R: Real> Complex<R> {
    /// a b*.
    #[inline(always)]
    pub(crate) fn times_conjugate(self, b: Self) -> Self {
        Self { re: self.re * b.re + self.im * b.im, im: self.im * b.re - self.re * b.im }
    }

    /// x/a.
    #[inline(always)]
    pub(crate) fn fraction(x: R, a: Self) -> Self {
        let scale = x / a.norm_sqr();
        Self { re: a.re * scale, im: -(a.im * scale) }
    }

    /// The real number `x`.
    #[inline(always)]
    pub(crate) fn real(x: R) -> Self {
        Self { re: x, im: x.splat(0.0) }
    }

    /// −i z x.
    #[inline(always)]
    pub(crate) fn turned_back(self, x: R) -> Self {
        Self { re: self.im * x, im: -(self.re * x) }
    }

    /// a b with the same `b` in every lane.
    #[inline(always)]
    pub(crate) fn times(self, b: Complex64) -> Self {
        Self { re: self.re * b.re - self.im * b.im, im: self.re * b.im + self.im * b.re }
    }

    /// |z|².
    #[inline(always)]
    pub(crate) fn norm_sqr(self) -> R {
        self.re * self.re + self.im * self.im
    }

    /// a/b.
    #[inline(always)]
    pub(crate) fn over(self, b: Self) -> Self {
        self.times_conjugate(b) * (b.re.splat(1.0) / b.norm_sqr())
    }
}

/// a/b and c/d, with one division.
#[inline(always)]
pub(crate) fn ratios<R: Real>([a, c]: [Complex<R>; 2], [b, d]: [Complex<R>; 2]) -> [Complex<R>; 2] {
    let (b2, d2) = (b.norm_sqr(), d.norm_sqr());
    let per_both = b2.splat(1.0) / (b2 * d2);
    [a.times_conjugate(b) * (per_both * d2), c.times_conjugate(d) * (per_both * b2)]
}

impl From<Complex64> for Complex<f64> {
    #[inline(always)]
    fn from(z: Complex64) -> Self {
        Self { re: z.re, im: z.im }
    }
}

impl From<Complex<f64>> for Complex64 {
    #[inline(always)]
    fn from(z: Complex<f64>) -> Self {
        Self::new(z.re, z.im)
    }
}

impl<R: Real> Add<R> for Complex<R> {
    type Output = Self;

    #[inline(always)]
    fn add(self, x: R) -> Self {
        Self { re: self.re + x, im: self.im }
    }
}

impl<R: Real> Add for Complex<R> {
    type Output = Self;

    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self { re: self.re + b.re, im: self.im + b.im }
    }
}

impl<R: Real> Sub for Complex<R> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Self { re: self.re - b.re, im: self.im - b.im }
    }
}

impl<R: Real> Mul<R> for Complex<R> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, x: R) -> Self {
        Self { re: self.re * x, im: self.im * x }
    }
}

impl<R: Real> Mul for Complex<R> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        Self { re: self.re * b.re - self.im * b.im, im: self.re * b.im + self.im * b.re }
    }
}

#[cfg(test)]
mod tests {
    use super::{wide::SimdKind, *};

    #[test]
    fn the_falling_exponential_is_that_of_the_standard_library() {
        for k in 0..=70_000 {
            let x = -0.01 * f64::from(k) - 1e-5 * f64::from(k % 97);
            let (got, expected) = (x.exp_falling(), x.exp());
            // Two units in the last place.
            assert!((got - expected).abs() <= 4.5e-16 * expected, "{x}: {got:e} {expected:e}");
        }
        assert_eq!([0f64, -709.0].map(f64::exp_falling), [1.0, 0.0]);
        assert_eq!([-1e300, f64::NEG_INFINITY].map(f64::exp_falling), [0.0, 0.0]);
        assert!(f64::NAN.exp_falling().is_nan());
    }

    #[test]
    fn numbers_are_rounded_and_kept_within_their_range() {
        let x = [-3.0, -0.2, 0.4, 0.6, 6.7, 7.2, 1e300, f64::INFINITY, f64::NAN];
        let want = [0.0, 0.0, 0.0, 1.0, 7.0, 7.0, 7.0, 7.0, 0.0];
        assert_eq!(x.map(|x| x.rounded_within(7.0)), want);
    }

    #[inline(always)]
    fn formula<R: Real>(x: R, y: R) -> R {
        let z = Complex { re: x, im: y - 0.3 };
        let w = z.over(Complex { re: y, im: x * 2.0 + 1.0 }) * (x * x + y).sqrt();
        let (sin, _) = w.im.sin_cos();
        (x - y).select((-(w.norm_sqr())).exp_falling(), (w.re + sin).abs() / y)
    }

    /// The formula in the registers of this processor.
    struct LaneFormula<'a>([f64; WIDTH], [f64; WIDTH], &'a mut [f64; WIDTH]);

    impl LaneKernel for LaneFormula<'_> {
        #[inline(always)]
        fn run<V: SimdLevel>(self, vectors: V) {
            *self.2 = vectors.store(formula(vectors.load(&self.0), vectors.load(&self.1)));
        }
    }

    #[test]
    fn every_lane_has_the_bits_of_its_number_alone() {
        let x = [0.1, 7.0, 0.2, 1e-3, -0.7, 1e9, 0.5, 1.0];
        let y = [0.4, 6.9, 0.3, 0.0, -2e-5, 3.0, 0.6, 1.0];
        let alone = std::array::from_fn(|k| formula(x[k], y[k]).to_bits());
        let mut batch = [0.0; WIDTH];
        for kind in SimdKind::of_this_processor() {
            kind.run(LaneFormula(x, y, &mut batch));
            assert_eq!(batch.map(f64::to_bits), alone, "{kind:?}");
        }
    }

    #[test]
    fn what_is_not_a_number_chooses_and_stays_the_same_in_every_kind_of_lane() {
        let x = [f64::NAN, -0.0, f64::INFINITY, f64::NEG_INFINITY, 0.0, -f64::NAN, 1e-320, -1e-320];
        let y = [1.0, f64::NAN, -2.0, -0.0, f64::INFINITY, 3.0, f64::NAN, 4.0];
        let alone = std::array::from_fn(|k| x[k].select(y[k], 5.0).to_bits());
        let mut batch = [0.0; WIDTH];
        for kind in SimdKind::of_this_processor() {
            kind.run(Choice(x, y, &mut batch));
            assert_eq!(batch.map(f64::to_bits), alone, "{kind:?}");
        }
    }

    /// The second numbers where the first are not negative, 5 elsewhere.
    struct Choice<'a>([f64; WIDTH], [f64; WIDTH], &'a mut [f64; WIDTH]);

    impl LaneKernel for Choice<'_> {
        #[inline(always)]
        fn run<V: SimdLevel>(self, vectors: V) {
            let (x, y) = (vectors.load(&self.0), vectors.load(&self.1));
            *self.2 = vectors.store(x.select(y, x.splat(5.0)));
        }
    }
}
