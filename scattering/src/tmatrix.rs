//! Transition matrices: how a particle answers the multipoles of the light around it.
//!
//! The field of every multipole (l, m) derives from u = z_l(kr) P̃_l^m(cos θ) e^{imφ}: an electric
//! one e = ∇×∇×(**r**u) and a magnetic one h = ik∇×(**r**u), regular with z = j and outgoing with
//! z = h⁽¹⁾. A body of revolution about the axis of θ answers regular waves of the order m with
//! outgoing ones of the same order, $$ \mathbf{w}_m = \mathbf{T}_m \mathbf{v}_m $$ and T_{−m} is T_m
//! with the sign of the elements between e and h changed. Within a block the electric multipoles
//! come first, each kind with l from max(1, m) up.
//!
//! P. C. Waterman, Phys. Rev. D 3, 825 (1971); M. I. Mishchenko, L. D. Travis and A. A. Lacis,
//! *Scattering, Absorption, and Emission of Light by Small Particles* (Cambridge, 2002).

use faer::{Mat, linalg::solvers::Solve};
use num_complex::Complex64;

use crate::special::harmonics::Harmonics;

pub mod waves;

/// A complex matrix.
pub type Matrix = Mat<Complex64>;

/// The largest l that is computed; a sphere of 80 wavelengths around needs as many.
pub const MOST: usize = 100;

/// The blocks of a particle for the orders m = 0 … m_max.
#[derive(Clone, Debug)]
pub struct TMatrix {
    /// The largest l.
    pub l_max: usize,
    /// T_m.
    pub blocks: Vec<Matrix>,
}

impl TMatrix {
    /// The matrix of a sphere with the Mie coefficients (a_l, b_l), l from 1.
    pub fn sphere(coefficients: &[(Complex64, Complex64)]) -> Self {
        let l_max = coefficients.len();
        let block = |m: usize| {
            let size = l_max + 1 - Harmonics::l_min(m);
            Matrix::from_fn(2 * size, 2 * size, |row, column| {
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

    /// The largest m.
    pub fn m_max(&self) -> usize {
        self.blocks.len() - 1
    }
}

/// a⁻¹ b.
pub(crate) fn solve(a: &Matrix, b: &Matrix) -> Matrix {
    a.partial_piv_lu().solve(b)
}

/// Whether every element is a finite number.
pub(crate) fn is_finite(matrix: &Matrix) -> bool {
    (0..matrix.ncols()).all(|column| matrix.col(column).iter().all(|z| z.is_finite()))
}
