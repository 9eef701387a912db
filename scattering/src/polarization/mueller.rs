//! Mueller matrices.

use std::ops::{Add, AddAssign, Index, IndexMut, Mul, MulAssign, Sub};

use super::Stokes;

/// A 4×4 Mueller matrix; the row index is the output. A BRDF is in 1/sr.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mueller(pub [[f64; 4]; 4]);

impl Mueller {
    /// The zero matrix: no light.
    pub const ZERO: Self = Self([[0.0; 4]; 4]);

    /// The ideal depolarizer that returns the fraction `r`.
    pub fn depolarizer(r: f64) -> Self {
        Self::diagonal([r, 0.0, 0.0, 0.0])
    }

    /// The diagonal matrix with these elements.
    pub fn diagonal(d: [f64; 4]) -> Self {
        let mut m = Self::ZERO;
        for (k, value) in d.into_iter().enumerate() {
            m.0[k][k] = value;
        }
        m
    }

    /// The matrix whose sixteen elements are given row by row.
    pub fn from_row_major(v: [f64; 16]) -> Self {
        Self(std::array::from_fn(|i| std::array::from_fn(|j| v[4 * i + j])))
    }

    /// The sixteen elements row by row.
    pub fn to_row_major(self) -> [f64; 16] {
        std::array::from_fn(|k| self.0[k / 4][k % 4])
    }

    /// The transposed matrix.
    pub fn transposed(self) -> Self {
        Self(std::array::from_fn(|i| std::array::from_fn(|j| self.0[j][i])))
    }

    /// The largest absolute value of an element; NaN elements are passed over.
    pub fn largest(&self) -> f64 {
        self.0.iter().flatten().fold(0.0, |m, x| m.max(x.abs()))
    }
}

impl Index<(usize, usize)> for Mueller {
    type Output = f64;

    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        &self.0[i][j]
    }
}

impl IndexMut<(usize, usize)> for Mueller {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut f64 {
        &mut self.0[i][j]
    }
}

impl Mul for Mueller {
    type Output = Self;

    fn mul(self, r: Self) -> Self {
        Self(std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..4).map(|k| self.0[i][k] * r.0[k][j]).sum())
        }))
    }
}

impl Mul<f64> for Mueller {
    type Output = Self;

    fn mul(mut self, factor: f64) -> Self {
        self *= factor;
        self
    }
}

impl MulAssign<f64> for Mueller {
    #[inline]
    fn mul_assign(&mut self, factor: f64) {
        for row in &mut self.0 {
            for x in row {
                *x *= factor;
            }
        }
    }
}

impl Mul<Stokes> for Mueller {
    type Output = Stokes;

    fn mul(self, s: Stokes) -> Stokes {
        Stokes(self.0.map(|row| Stokes(row).dot(&s)))
    }
}

impl Add for Mueller {
    type Output = Self;

    fn add(mut self, r: Self) -> Self {
        self += r;
        self
    }
}

impl AddAssign for Mueller {
    #[inline]
    fn add_assign(&mut self, r: Self) {
        for (row, other) in self.0.iter_mut().zip(r.0) {
            for (x, y) in row.iter_mut().zip(other) {
                *x += y;
            }
        }
    }
}

impl Sub for Mueller {
    type Output = Self;

    fn sub(self, r: Self) -> Self {
        self + r * -1.0
    }
}
