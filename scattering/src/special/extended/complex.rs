//! Complex numbers of [`Extended`] parts, and linear systems of them.

use std::ops::{Add, Mul, Neg, Sub};

use num_complex::Complex64;

use super::Extended;

/// A complex number.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ExtendedComplex {
    /// Real part.
    pub re: Extended,
    /// Imaginary part.
    pub im: Extended,
}

impl ExtendedComplex {
    /// 0.
    pub const ZERO: Self = Self { re: Extended::ZERO, im: Extended::ZERO };

    /// re + i im.
    #[inline(always)]
    pub const fn new(re: Extended, im: Extended) -> Self {
        Self { re, im }
    }

    /// The nearest number of `f64`.
    pub fn to_c64(self) -> Complex64 {
        Complex64::new(self.re.to_f64(), self.im.to_f64())
    }

    /// The number times a real one.
    #[inline(always)]
    pub fn times(self, x: Extended) -> Self {
        Self { re: self.re * x, im: self.im * x }
    }

    /// i times the number.
    #[inline(always)]
    pub fn turned(self) -> Self {
        Self { re: -self.im, im: self.re }
    }

    /// 1/z.
    pub fn inverse(self) -> Self {
        let square = self.re * self.re + self.im * self.im;
        Self { re: self.re / square, im: -(self.im / square) }
    }

    /// The sine and the cosine.
    pub fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.re.sin_cos();
        if self.im == Extended::ZERO {
            return (s.into(), c.into());
        }
        let (up, down) = (self.im.exp(), (-self.im).exp());
        let cosh = (up + down).times_power(0.5);
        let sinh = if self.im.to_f64().abs() < 0.5 {
            series_of_sinh(self.im)
        } else {
            (up - down).times_power(0.5)
        };
        (Self::new(s * cosh, c * sinh), Self::new(c * cosh, -(s * sinh)))
    }
}

/// sinh x for |x| < 0.5.
fn series_of_sinh(x: Extended) -> Extended {
    let (mut total, mut term) = (x, x);
    for k in 1..13 {
        let k = 2.0 * f64::from(k);
        term = term * x * x / Extended::from(k * (k + 1.0));
        total = total + term;
    }
    total
}

impl From<Extended> for ExtendedComplex {
    fn from(re: Extended) -> Self {
        Self { re, im: Extended::ZERO }
    }
}

impl From<Complex64> for ExtendedComplex {
    fn from(z: Complex64) -> Self {
        Self { re: z.re.into(), im: z.im.into() }
    }
}

impl Neg for ExtendedComplex {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { re: -self.re, im: -self.im }
    }
}

impl Add for ExtendedComplex {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl Sub for ExtendedComplex {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl Mul for ExtendedComplex {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

/// Solves a x = b for all columns of `b`, matrices as rows, by elimination with the largest pivot
/// of each column; nothing if a pivot is zero or not a number.
pub fn solve(
    mut a: Vec<Vec<ExtendedComplex>>,
    mut b: Vec<Vec<ExtendedComplex>>,
) -> Option<Vec<Vec<ExtendedComplex>>> {
    let n = a.len();
    for column in 0..n {
        let size = |row: &Vec<ExtendedComplex>| row[column].to_c64().norm_sqr();
        let pivot = (column..n).max_by(|&i, &j| size(&a[i]).total_cmp(&size(&a[j])))?;
        a.swap(column, pivot);
        b.swap(column, pivot);
        let largest = size(&a[column]);
        if largest == 0.0 || !largest.is_finite() {
            return None;
        }
        let inverse = a[column][column].inverse();
        let (above, below) = a.split_at_mut(column + 1);
        let (b_above, b_below) = b.split_at_mut(column + 1);
        let (pivot_row, pivot_right) = (&above[column], &b_above[column]);
        for (row, right) in below.iter_mut().zip(b_below) {
            let factor = row[column] * inverse;
            subtract(&mut row[column + 1..], &pivot_row[column + 1..], factor);
            subtract(right, pivot_right, factor);
        }
    }
    for column in (0..n).rev() {
        let inverse = a[column][column].inverse();
        let (above, rest) = b.split_at_mut(column);
        let solved = &mut rest[0];
        solved.iter_mut().for_each(|x| *x = *x * inverse);
        for (row, right) in above.iter_mut().enumerate() {
            subtract(right, solved, a[row][column]);
        }
    }
    Some(b)
}

fn subtract(from: &mut [ExtendedComplex], row: &[ExtendedComplex], factor: ExtendedComplex) {
    for (x, y) in from.iter_mut().zip(row) {
        *x = *x - factor * *y;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(re: f64, im: f64) -> ExtendedComplex {
        Complex64::new(re, im).into()
    }

    #[test]
    fn solutions_of_systems_fulfil_them() {
        // A Hilbert matrix, which leaves f64 without digits, turned in the complex plane.
        let n = 14;
        let element = |i: usize, j: usize| {
            number(1.0, 0.3).times(Extended::ONE / Extended::from((i + j + 1) as f64))
        };
        let matrix = |of: &dyn Fn(usize, usize) -> ExtendedComplex| -> Vec<Vec<_>> {
            (0..n).map(|i| (0..n).map(|j| of(i, j)).collect()).collect()
        };
        let unit = |i: usize, j: usize| number(f64::from(i == j), 0.0);
        let inverse = solve(matrix(&element), matrix(&unit)).unwrap();
        for i in 0..n {
            for j in 0..n {
                let terms = (0..n).map(|k| element(i, k) * inverse[k][j]);
                let product = terms.fold(ExtendedComplex::ZERO, |sum, x| sum + x);
                let difference = (product - unit(i, j)).to_c64().norm();
                assert!(difference < 1e-10, "{i} {j} {difference:e}");
            }
        }
        assert!(solve(vec![vec![ExtendedComplex::ZERO]], vec![vec![number(1.0, 0.0)]]).is_none());
    }

    #[test]
    fn sines_of_complex_numbers_are_those_of_f64() {
        for z in [(0.3, 0.2), (5.0, -3.0), (2.0, 0.0), (1.0, 1e-12)] {
            let (s, c) = number(z.0, z.1).sin_cos();
            let z = Complex64::new(z.0, z.1);
            assert!((s.to_c64() - z.sin()).norm() < 1e-14 * z.sin().norm());
            assert!((c.to_c64() - z.cos()).norm() < 1e-14 * z.cos().norm());
            let one = s * s + c * c;
            assert!((one - number(1.0, 0.0)).to_c64().norm() < 1e-26);
        }
    }
}
