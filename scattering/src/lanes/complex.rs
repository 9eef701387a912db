//! Complex numbers, one or a batch of lanes.

use std::ops::{Add, Mul, Sub};

use num_complex::Complex64;

use super::real::Real;

/// A complex number, or a batch of lanes.
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
