//! One medium and one film of a stack.

use num_complex::Complex64;

use super::{amplitudes::SpAmplitudes, root::phase_factor};

/// A smaller index is replaced by this one.
const LEAST_INDEX: f64 = 1e-6;

#[derive(Clone, Copy, Debug)]
pub(super) struct FilmMedium {
    pub(super) index: Complex64,
    pub(super) epsilon: Complex64,
    pub(super) inverse_epsilon: Complex64,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct FilmLayer {
    pub(super) medium: FilmMedium,
    /// 2πt/λ.
    pub(super) phase: f64,
    /// t, µm.
    pub(super) thickness: f64,
}

impl FilmMedium {
    pub(super) fn new(index: Complex64) -> Self {
        // A film whose graded index passes through 0 would have no admittance.
        let index =
            if index.norm_sqr() < LEAST_INDEX * LEAST_INDEX { LEAST_INDEX.into() } else { index };
        let epsilon = index * index;
        Self { index, epsilon, inverse_epsilon: 1.0 / epsilon }
    }

    pub(super) fn admittances(&self, q: Complex64) -> SpAmplitudes {
        SpAmplitudes { s: q, p: q * self.inverse_epsilon }
    }
}

impl FilmLayer {
    /// True if a wave with this q travels in it without loss.
    pub(super) fn is_clear(&self, q: Complex64) -> bool {
        q.im == 0.0 && self.medium.epsilon.im == 0.0
    }

    /// Factor of [`FieldVectors::pass`](super::vectors::FieldVectors::pass): e^{iδ} where the wave decays.
    pub(super) fn factor(&self, q: Complex64) -> Complex64 {
        if self.is_clear(q) { Complex64::ONE } else { phase_factor(q, self.phase) }
    }
}
