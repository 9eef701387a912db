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
    /// From y to x and from x to y; nothing where the axes do not mix.
    pub xy: Option<[ComplexMatrix; 2]>,
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
    /// k_x² + k_y² + k_z² of the waves in a homogeneous layer, in units of k₀², where it is not
    /// that of its permittivity.
    pub waves: Option<Complex64>,
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

    /// True if no harmonic scatters into another one.
    pub fn is_homogeneous(&self) -> bool {
        /// The size from which NIST's library counts an element.
        const COUNTED: f64 = 1e-10;
        let m = &self.epsilon.zz_inverse;
        let is_small = |i: usize, j: usize| i == j || m[(i, j)].norm() <= COUNTED;
        (0..m.nrows()).all(|i| (0..m.ncols()).all(|j| is_small(i, j)))
    }

    /// A homogeneous layer whose waves have 1/ε in place of ε in k_z, without permeability
    /// ([`Defect::CrossedHomogeneous`](crate::Defect::CrossedHomogeneous)).
    #[must_use]
    pub fn with_inverse_waves(self) -> Self {
        let n = self.mu.xx.nrows();
        let waves = Some(self.epsilon.zz_inverse[(0, 0)]);
        Self { mu: MaterialTensor::vacuum(n), waves, ..self }
    }

    /// U = E_y, V = −H_x for waves without k_y.
    pub fn across_s(&self, kx: &[f64]) -> CoupledOperators {
        let q = &self.epsilon.yy - framed(kx, &self.mu.zz_inverse, kx);
        let p = match self.waves {
            Some(waves) => diagonal(kx, |m, kx| (waves - kx * kx) / q[(m, m)]),
            None => self.mu.xx.clone(),
        };
        CoupledOperators { p, q }
    }

    /// U = H_y, V = E_x for waves without k_y.
    pub fn across_p(&self, kx: &[f64]) -> CoupledOperators {
        let p = self.epsilon.xx.clone();
        let q = match self.waves {
            Some(waves) => diagonal(kx, |m, kx| (waves - kx * kx) / p[(m, m)]),
            None => &self.mu.yy - framed(kx, &self.epsilon.zz_inverse, kx),
        };
        CoupledOperators { p, q }
    }

    /// U = (E_x, E_y), V = (H_y, −H_x) for any waves.
    pub fn conical(&self, lateral: &[(f64, f64)]) -> CoupledOperators {
        let kx: Vec<f64> = lateral.iter().map(|k| k.0).collect();
        let ky: Vec<f64> = lateral.iter().map(|k| k.1).collect();
        let (epsilon, mu) = (&self.epsilon, &self.mu);
        let [y_to_x, x_to_y] = [0, 1];
        // V = (H_y, −H_x): the mixed elements of μ change places.
        let p_xy = mixed(&mu.xy, x_to_y, -1.0, -framed(&kx, &epsilon.zz_inverse, &ky));
        let p_yx = mixed(&mu.xy, y_to_x, -1.0, -framed(&ky, &epsilon.zz_inverse, &kx));
        let q_xy = mixed(&epsilon.xy, y_to_x, 1.0, framed(&ky, &mu.zz_inverse, &kx));
        let q_yx = mixed(&epsilon.xy, x_to_y, 1.0, framed(&kx, &mu.zz_inverse, &ky));
        let q = blocks(
            &(&epsilon.xx - framed(&ky, &mu.zz_inverse, &ky)),
            &q_xy,
            &q_yx,
            &(&epsilon.yy - framed(&kx, &mu.zz_inverse, &kx)),
        );
        let p = match self.waves {
            Some(waves) => inverse_by_harmonic(&q, |m| waves - kx[m] * kx[m] - ky[m] * ky[m]),
            None => blocks(
                &(&mu.yy - framed(&kx, &epsilon.zz_inverse, &kx)),
                &p_xy,
                &p_yx,
                &(&mu.xx - framed(&ky, &epsilon.zz_inverse, &ky)),
            ),
        };
        CoupledOperators { p, q }
    }
}

/// diag(`of`(harmonic, k)).
fn diagonal(k: &[f64], of: impl Fn(usize, f64) -> Complex64) -> ComplexMatrix {
    ComplexMatrix::from_fn(
        k.len(),
        k.len(),
        |i, j| {
            if i == j { of(i, k[i]) } else { Complex64::ZERO }
        },
    )
}

/// P with PQ = `square` for every harmonic of a homogeneous layer.
fn inverse_by_harmonic(q: &ComplexMatrix, square: impl Fn(usize) -> Complex64) -> ComplexMatrix {
    let n = q.nrows() / 2;
    let mut p = ComplexMatrix::zeros(2 * n, 2 * n);
    for m in 0..n {
        let (a, b, c, d) = (q[(m, m)], q[(m, n + m)], q[(n + m, m)], q[(n + m, n + m)]);
        let scale = square(m) / (a * d - b * c);
        p[(m, m)] = d * scale;
        p[(m, n + m)] = -b * scale;
        p[(n + m, m)] = -c * scale;
        p[(n + m, n + m)] = a * scale;
    }
    p
}

/// diag(left) · m · diag(right).
fn framed(left: &[f64], m: &ComplexMatrix, right: &[f64]) -> ComplexMatrix {
    ComplexMatrix::from_fn(m.nrows(), m.ncols(), |i, j| m[(i, j)] * (left[i] * right[j]))
}

fn mixed(
    xy: &Option<[ComplexMatrix; 2]>,
    which: usize,
    sign: f64,
    other: ComplexMatrix,
) -> ComplexMatrix {
    match xy {
        Some(xy) => other + &xy[which] * faer::Scale(Complex64::from(sign)),
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
