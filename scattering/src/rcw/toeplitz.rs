//! Toeplitz matrices of Fourier coefficients.

use num_complex::Complex64;

use super::dense::{identity, solve};
use crate::special::matrix::ComplexMatrix;

/// Fourier coefficients −M…M of a periodic function.
#[derive(Clone, Debug, PartialEq)]
pub struct FourierSeries(pub Vec<Complex64>);

impl FourierSeries {
    /// The coefficient of order `m`.
    ///
    /// # Panics
    ///
    /// If it was not computed.
    pub fn at(&self, m: isize) -> Complex64 {
        let middle = self.0.len() / 2;
        self.0[middle.checked_add_signed(m).expect("a computed order")]
    }

    /// The matrix c_{i−j}, `n` × `n`: multiplication by the function.
    pub fn matrix(&self, n: usize) -> ComplexMatrix {
        ComplexMatrix::from_fn(n, n, |i, j| self.at(i as isize - j as isize))
    }
}

/// The inverse of `m`.
pub fn inverse(m: &ComplexMatrix) -> ComplexMatrix {
    crate::interrupt::check();
    solve(m.clone(), identity(m.nrows()))
}
