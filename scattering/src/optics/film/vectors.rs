//! Field vectors carried through the films of a stack.

use num_complex::Complex64;

use super::{
    amplitudes::{SpAmplitudes, TangentialFields},
    clear::{SMALL_PHASE, passed},
    layer::{FilmLayer, FilmMedium},
    root::phase_factor,
};

const I: Complex64 = Complex64::I;
const ONE: Complex64 = Complex64::ONE;

/// The two field vectors (s, p) at a face, each times a common phase factor.
#[derive(Clone, Copy)]
pub(super) struct FieldVectors {
    pub(super) s: [Complex64; 2],
    pub(super) p: [Complex64; 2],
}

/// Boundary values of a wave at a face of the stack: X ± Z of both polarizations.
pub(super) struct EntranceFields {
    pub(super) y0: SpAmplitudes,
    pub(super) x: SpAmplitudes,
    pub(super) z: SpAmplitudes,
    /// The product of the factors of the films passed.
    pub(super) phase: Complex64,
}

impl EntranceFields {
    pub(super) fn reflection(&self) -> SpAmplitudes {
        SpAmplitudes {
            s: (self.x.s - self.z.s) / (self.x.s + self.z.s),
            p: (self.x.p - self.z.p) / (self.x.p + self.z.p),
        }
    }

    pub(super) fn transmission(&self, index_ratio: Complex64) -> SpAmplitudes {
        SpAmplitudes {
            s: 2.0 * self.y0.s * self.phase / (self.x.s + self.z.s),
            p: index_ratio * 2.0 * self.y0.p * self.phase / (self.x.p + self.z.p),
        }
    }
}

impl FieldVectors {
    /// Carries both vectors through `layer`, from its far to its near face, and returns the
    /// factor that they were multiplied by.
    #[inline]
    pub(super) fn pass(&mut self, layer: &FilmLayer, q: Complex64) -> Complex64 {
        if layer.phase == 0.0 {
            return ONE;
        }
        if layer.is_clear(q) {
            let v = passed([self.s, self.p].map(|v| v.map(Into::into)), layer, q.re);
            [self.s, self.p] = v.map(|v| v.map(Into::into));
            return ONE;
        }
        let delta = q * layer.phase;
        let factor = phase_factor(q, layer.phase);
        let double = factor * factor;
        let cos = 0.5 * (double + 1.0);
        // sin δ e^{iδ} and the same over q, which stays finite where q vanishes.
        let (sin, sin_over_q) = if delta.norm_sqr() < SMALL_PHASE * SMALL_PHASE {
            let d2 = delta * delta;
            let sinc = ONE - d2 / 6.0 * (ONE - d2 / 20.0 * (ONE - d2 / 42.0));
            (delta * sinc * factor, layer.phase * sinc * factor)
        } else {
            let sin = -0.5 * I * (double - 1.0);
            (sin, sin / q)
        };
        let FilmMedium { epsilon, inverse_epsilon, .. } = layer.medium;
        let [a, b] = self.s;
        self.s = [a * cos - I * b * sin_over_q, b * cos - I * a * q * sin];
        let [a, b] = self.p;
        self.p =
            [a * cos - I * b * epsilon * sin_over_q, b * cos - I * a * q * inverse_epsilon * sin];
        factor
    }

    pub(super) fn fields(&self) -> TangentialFields {
        TangentialFields { e: self.s[0], u: self.p[0], w: self.p[1] }
    }
}
