//! A layer of the structure as operators on harmonics, and Maxwell's equations in it.
//!
//! $$ P = \begin{pmatrix} \mu_{yy} - K_x\epsilon_{zz}^{-1}K_x & -\mu_{xy} - K_x\epsilon_{zz}^{-1}K_y \\
//! -\mu_{xy} - K_y\epsilon_{zz}^{-1}K_x & \mu_{xx} - K_y\epsilon_{zz}^{-1}K_y \end{pmatrix} $$
//! $$ Q = \begin{pmatrix} \epsilon_{xx} - K_y\mu_{zz}^{-1}K_y & \epsilon_{xy} + K_y\mu_{zz}^{-1}K_x \\
//! \epsilon_{xy} + K_x\mu_{zz}^{-1}K_y & \epsilon_{yy} - K_x\mu_{zz}^{-1}K_x \end{pmatrix} $$
//!
//! The entries are matrices. The caller chooses the factorization of each product of Fourier series
//! by Li's rules.

use num_complex::Complex64;

use crate::special::matrix::ComplexMatrix;

/// One kind of material constant, ε or μ, as it acts on lateral and normal fields.
#[derive(Clone, Debug)]
pub struct MaterialTensor {
    /// From x to x.
    pub xx: ComplexMatrix,
    /// Between x and y; nothing where the axes do not mix.
    pub xy: Option<ComplexMatrix>,
    /// From y to y.
    pub yy: ComplexMatrix,
    /// The inverse of the constant along z.
    pub zz_inverse: ComplexMatrix,
}

impl MaterialTensor {
    /// Vacuum, for `n` harmonics.
    pub fn vacuum(n: usize) -> Self {
        let one = ComplexMatrix::identity(n, n);
        Self { xx: one.clone(), xy: None, yy: one.clone(), zz_inverse: one }
    }
}

/// A layer at one wavelength.
#[derive(Clone, Debug)]
pub struct LayerOperators {
    /// Thickness times k₀.
    pub depth: f64,
    /// Permittivity.
    pub epsilon: MaterialTensor,
    /// Permeability.
    pub mu: MaterialTensor,
}

/// The matrices of U' = iPV, V' = iQU.
#[derive(Clone, Debug)]
pub struct CoupledOperators {
    /// From V to U'.
    pub p: ComplexMatrix,
    /// From U to V'.
    pub q: ComplexMatrix,
}

impl LayerOperators {
    /// True if x and y do not mix.
    pub fn is_diagonal(&self) -> bool {
        self.epsilon.xy.is_none() && self.mu.xy.is_none()
    }

    /// U = E_y, V = −H_x for waves without k_y.
    pub fn across_s(&self, kx: &[f64]) -> CoupledOperators {
        CoupledOperators {
            p: self.mu.xx.clone(),
            q: &self.epsilon.yy - framed(kx, &self.mu.zz_inverse, kx),
        }
    }

    /// U = H_y, V = E_x for waves without k_y.
    pub fn across_p(&self, kx: &[f64]) -> CoupledOperators {
        CoupledOperators {
            p: self.epsilon.xx.clone(),
            q: &self.mu.yy - framed(kx, &self.epsilon.zz_inverse, kx),
        }
    }

    /// U = (E_x, E_y), V = (H_y, −H_x) for any waves.
    pub fn conical(&self, lateral: &[(f64, f64)]) -> CoupledOperators {
        let kx: Vec<f64> = lateral.iter().map(|k| k.0).collect();
        let ky: Vec<f64> = lateral.iter().map(|k| k.1).collect();
        let (epsilon, mu) = (&self.epsilon, &self.mu);
        let p_xy = mixed(&mu.xy, -1.0, -framed(&kx, &epsilon.zz_inverse, &ky));
        let p_yx = mixed(&mu.xy, -1.0, -framed(&ky, &epsilon.zz_inverse, &kx));
        let q_xy = mixed(&epsilon.xy, 1.0, framed(&ky, &mu.zz_inverse, &kx));
        let q_yx = mixed(&epsilon.xy, 1.0, framed(&kx, &mu.zz_inverse, &ky));
        CoupledOperators {
            p: blocks(
                &(&mu.yy - framed(&kx, &epsilon.zz_inverse, &kx)),
                &p_xy,
                &p_yx,
                &(&mu.xx - framed(&ky, &epsilon.zz_inverse, &ky)),
            ),
            q: blocks(
                &(&epsilon.xx - framed(&ky, &mu.zz_inverse, &ky)),
                &q_xy,
                &q_yx,
                &(&epsilon.yy - framed(&kx, &mu.zz_inverse, &kx)),
            ),
        }
    }
}

/// diag(left) · m · diag(right).
fn framed(left: &[f64], m: &ComplexMatrix, right: &[f64]) -> ComplexMatrix {
    ComplexMatrix::from_fn(m.nrows(), m.ncols(), |i, j| m[(i, j)] * (left[i] * right[j]))
}

fn mixed(xy: &Option<ComplexMatrix>, sign: f64, other: ComplexMatrix) -> ComplexMatrix {
    match xy {
        Some(xy) => other + xy * faer::Scale(Complex64::from(sign)),
        None => other,
    }
}

fn blocks(
    xx: &ComplexMatrix,
    xy: &ComplexMatrix,
    yx: &ComplexMatrix,
    yy: &ComplexMatrix,
) -> ComplexMatrix {
    let n = xx.nrows();
    ComplexMatrix::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, true) => xx[(i, j)],
        (true, false) => xy[(i, j - n)],
        (false, true) => yx[(i - n, j)],
        (false, false) => yy[(i - n, j - n)],
    })
}
