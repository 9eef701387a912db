//! Transmission and reflection of light by parallel interfaces.
//!
//! All interfaces have the same s and p directions, so every matrix has the form M(diag(t_s, t_p)) or
//! is a sum of such matrices. The intensities of s and p and the product c = t_p t_s* are each
//! multiplied separately. Reflections between two interfaces are a geometric series of each.

use num_complex::Complex64;

use crate::{Mueller, optics::film::SpAmplitudes};

/// The factors of s and p light and of their coherence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TransmissionFactors {
    /// Intensity of s.
    pub(super) s: f64,
    /// Intensity of p.
    pub(super) p: f64,
    /// t_p t_s*.
    pub(super) c: Complex64,
}

impl TransmissionFactors {
    /// Complete transmission.
    pub(super) const FREE: Self = Self { s: 1.0, p: 1.0, c: Complex64::ONE };
    /// No light passes.
    pub(super) const NONE: Self = Self { s: 0.0, p: 0.0, c: Complex64::ZERO };

    /// The transmission with the amplitudes `t`, times `factor`.
    pub(super) fn of(t: SpAmplitudes, factor: f64) -> Self {
        Self {
            s: factor * t.s.norm_sqr(),
            p: factor * t.p.norm_sqr(),
            c: factor * t.p * t.s.conj(),
        }
    }

    /// The same with other intensities and the same phase.
    pub(super) fn with_intensities(self, s: f64, p: f64) -> Self {
        let before = self.s * self.p;
        let c = if before > 0.0 { self.c * (s * p / before).sqrt() } else { Complex64::ZERO };
        Self { s, p, c }
    }

    /// One transmission after the other.
    pub(super) fn then(self, next: Self) -> Self {
        Self { s: self.s * next.s, p: self.p * next.p, c: self.c * next.c }
    }

    /// The same with every intensity times `factor`.
    pub(super) fn scaled(self, factor: f64) -> Self {
        Self { s: self.s * factor, p: self.p * factor, c: self.c * factor }
    }

    /// The sum of both.
    pub(super) fn plus(self, other: Self) -> Self {
        Self { s: self.s + other.s, p: self.p + other.p, c: self.c + other.c }
    }

    /// 1 + x + x² + … of a round trip x.
    pub(super) fn repeated(self) -> Self {
        let sum = |x: f64| 1.0 / (1.0 - x);
        Self { s: sum(self.s), p: sum(self.p), c: 1.0 / (1.0 - self.c) }
    }

    /// Its Mueller matrix.
    pub(super) fn matrix(&self) -> Mueller {
        let (sum, difference) = (0.5 * (self.s + self.p), 0.5 * (self.s - self.p));
        let Complex64 { re, im } = self.c;
        Mueller([
            [sum, difference, 0.0, 0.0],
            [difference, sum, 0.0, 0.0],
            [0.0, 0.0, re, -im],
            [0.0, 0.0, im, re],
        ])
    }

    /// `row`, a row of a Mueller matrix, times this matrix.
    pub(super) fn before(&self, [i, q, u, v]: [f64; 4]) -> [f64; 4] {
        let (sum, difference) = (0.5 * (self.s + self.p), 0.5 * (self.s - self.p));
        let Complex64 { re, im } = self.c;
        [sum * i + difference * q, difference * i + sum * q, re * u + im * v, re * v - im * u]
    }

    /// First row of the matrix: the transmitted power for an incident Stokes vector.
    pub(super) fn row(&self) -> [f64; 4] {
        [0.5 * (self.s + self.p), 0.5 * (self.s - self.p), 0.0, 0.0]
    }
}

/// strength · u ⊗ t: complete depolarization between `entering` and `leaving`, both given as rows
/// for a beam from outside.
pub(super) fn depolarized(strength: f64, leaving: [f64; 4], entering: [f64; 4]) -> Mueller {
    // The reversed beam has the opposite U.
    let [i, q, u, v] = leaving.map(|x| strength * x);
    Mueller([i, q, -u, v].map(|out| entering.map(|into| out * into)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn passage() -> TransmissionFactors {
        let t = SpAmplitudes { s: Complex64::new(0.5, 0.2), p: Complex64::new(-0.1, 0.7) };
        TransmissionFactors::of(t, 1.3)
    }

    #[test]
    fn a_passage_is_the_matrix_of_its_amplitudes() {
        let t = SpAmplitudes { s: Complex64::new(0.5, 0.2), p: Complex64::new(-0.1, 0.7) };
        let difference = passage().matrix() - t.jones().mueller() * 1.3;
        assert!(difference.largest() < 1e-15);
    }

    #[test]
    fn the_series_of_round_trips_is_the_inverse_of_the_matrix() {
        let trip = passage().scaled(0.4);
        let one = Mueller::diagonal([1.0; 4]);
        let product = (one - trip.matrix()) * trip.repeated().matrix();
        assert!((product - one).largest() < 1e-15);
    }
}
