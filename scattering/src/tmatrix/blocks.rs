//! The blocks of a T matrix.

use faer::linalg::solvers::Solve;
use num_complex::Complex64;

use super::waves::Multipole;
use crate::special::{harmonics::Harmonics, matrix::ComplexMatrix};

/// The largest l that is computed; a sphere of 80 wavelengths around needs as many.
pub const MOST: usize = 100;

/// The blocks of a particle for the orders m = 0 … m_max.
#[derive(Clone, Debug)]
pub struct TMatrix {
    /// The largest l.
    pub l_max: usize,
    /// T_m.
    pub blocks: Vec<ComplexMatrix>,
}

impl TMatrix {
    /// The matrix of a sphere with the Mie coefficients (a_l, b_l), l from 1.
    pub fn sphere(coefficients: &[(Complex64, Complex64)]) -> Self {
        let l_max = coefficients.len();
        let block = |m: usize| {
            let size = l_max + 1 - Harmonics::l_min(m);
            ComplexMatrix::from_fn(2 * size, 2 * size, |row, column| {
                let (a, b) = coefficients[l_max - size + row % size];
                match (row == column, row < size) {
                    (false, _) => Complex64::ZERO,
                    (true, true) => -a,
                    (true, false) => -b,
                }
            })
        };
        Self { l_max, blocks: (0..=l_max).map(block).collect() }
    }

    /// The same without the orders above `m_max`.
    pub(crate) fn truncated(mut self, m_max: usize) -> Self {
        self.blocks.truncate(m_max.saturating_add(1));
        self
    }

    /// The largest m.
    pub fn m_max(&self) -> usize {
        self.blocks.len() - 1
    }
}

/// Calls `each` with l − max(1, m) and the outgoing multipole w = B v for the first `rows` values
/// of l, v the regular waves of one order.
pub(crate) fn apply(
    block: &ComplexMatrix,
    regular: &[Multipole],
    rows: usize,
    mut each: impl FnMut(usize, Multipole),
) {
    let size = block.nrows() / 2;
    for row in 0..rows {
        let mut w = Multipole::default();
        for (column, v) in regular.iter().enumerate() {
            for (kind, at) in [row, size + row].into_iter().enumerate() {
                let (e, h) = (block[(at, column)], block[(at, size + column)]);
                w.p[kind] += e * v.p[0] + h * v.p[1];
                w.s[kind] += e * v.s[0] + h * v.s[1];
            }
        }
        each(row, w);
    }
}

/// a⁻¹ b.
pub(crate) fn solve(a: &ComplexMatrix, b: &ComplexMatrix) -> ComplexMatrix {
    a.partial_piv_lu().solve(b)
}

/// True if every element is a finite number.
pub(crate) fn is_finite(matrix: &ComplexMatrix) -> bool {
    (0..matrix.ncols()).all(|column| matrix.col(column).iter().all(|z| z.is_finite()))
}
