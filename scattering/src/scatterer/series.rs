//! Series of vector spherical harmonics: amplitudes and cross-sections from a_n, b_n.
//!
//! $$ S_1 = \sum_n \frac{2n+1}{n(n+1)} (a_n\pi_n + b_n\tau_n), \qquad
//!    S_2 = \sum_n \frac{2n+1}{n(n+1)} (a_n\tau_n + b_n\pi_n) $$
//!
//! π_n and τ_n depend on cos θ: π_{n+1} = [(2n+1)cos θ π_n − (n+1)π_{n−1}]/n and
//! τ_n = n cos θ π_n − (n+1)π_{n−1}. S1 ± S2 take one product each instead of two.
//!
//! C. F. Bohren and D. R. Huffman, *Absorption and Scattering of Light by Small Particles*
//! (Wiley, 1983), 4.4; W. J. Wiscombe, Appl. Opt. 19, 1505 (1980).

use std::f64::consts::{PI, TAU};

use num_complex::Complex64;

use super::CrossSections;
use crate::{Defect, Jones, Mode, ParameterNode};

/// NIST's number of terms of a sphere of size parameter `x`.
pub fn terms(x: f64) -> usize {
    // The exponent is NIST's; with 1/3 the number differs by one at isolated sizes.
    (x + 4.0 * x.powf(0.3333) + 2.0) as usize
}

/// Number of terms of a sphere of size parameter `x` beyond which all terms vanish.
///
/// ψ_n/ζ_n is below exp(−1.88·8^{3/2}) = 10⁻¹⁸ eight widths x^{1/3} of the turning point above it.
pub fn converged_terms(x: f64) -> usize {
    (x + 8.0 * x.cbrt()) as usize + 12
}

/// The number of terms for size parameter `x` in the mode of `node`: as many as matter, or NIST's.
pub fn terms_for(node: &ParameterNode, x: f64) -> usize {
    // Terms that NIST's number leaves out are above 10⁻⁹ in spheres larger than this.
    const SMALL: f64 = 30.0;
    let library = node.mode == Mode::Compat || (x > SMALL && node.reproduces(Defect::SeriesLength));
    if library { terms(x) } else { converged_terms(x) }
}

/// Coefficients of a sphere, prepared for sums over n.
#[derive(Clone, Debug, Default)]
pub struct MieSeries {
    /// (2n+1)/(n(n+1)) times a_n + b_n and a_n − b_n, n from 1.
    terms: Vec<(Complex64, Complex64)>,
}

impl MieSeries {
    /// The series with the coefficients (a_n, b_n), n from 1.
    pub fn new(coefficients: &[(Complex64, Complex64)]) -> Self {
        let term = |(at, (a, b)): (usize, &(Complex64, Complex64))| {
            let n = (at + 1) as f64;
            let factor = (2.0 * n + 1.0) / (n * (n + 1.0));
            ((a + b) * factor, (a - b) * factor)
        };
        Self { terms: coefficients.iter().enumerate().map(term).collect() }
    }

    /// The same without the terms at its end that are too small to change any sum.
    pub fn trimmed(mut self) -> Self {
        let size = |(plus, minus): &(Complex64, Complex64)| plus.norm() + minus.norm();
        let largest = self.terms.iter().map(size).fold(0.0, f64::max);
        let counts = |term| size(term) > 1e-22 * largest;
        self.terms.truncate(self.terms.iter().rposition(counts).map_or(1, |last| last + 1));
        self
    }

    /// The number of terms.
    pub fn len(&self) -> usize {
        self.terms.len()
    }

    /// True if there are no coefficients.
    pub fn is_empty(&self) -> bool {
        self.terms.is_empty()
    }

    /// (S1, S2) at the cosine of the scattering angle.
    pub fn amplitudes(&self, cos: f64) -> (Complex64, Complex64) {
        let (mut sum, mut difference) = (Complex64::ZERO, Complex64::ZERO);
        for ((plus, minus), (up, down)) in self.terms.iter().zip(AngularFunctions::new(cos)) {
            sum += plus * up;
            difference += minus * down;
        }
        (0.5 * (sum + difference), 0.5 * (sum - difference))
    }

    /// (S1, S2) from the values of [`AngularFunctions`] at one angle, at least as many as terms.
    pub fn amplitudes_from(&self, angular: &[(f64, f64)]) -> (Complex64, Complex64) {
        let (mut sum, mut difference) = (Complex64::ZERO, Complex64::ZERO);
        for ((plus, minus), (up, down)) in self.terms.iter().zip(angular) {
            sum += plus * up;
            difference += minus * down;
        }
        (0.5 * (sum + difference), 0.5 * (sum - difference))
    }

    /// Cross-sections in µm² for the wave number `k` 1/µm of the medium.
    pub fn cross_sections(&self, k: f64) -> CrossSections {
        let (mut scattering, mut extinction) = (0.0, 0.0);
        let mut back = Complex64::ZERO;
        for (at, (plus, minus)) in self.terms.iter().enumerate() {
            let n = (at + 1) as f64;
            let weight = n * (n + 1.0);
            // |a|² + |b|² = (|a+b|² + |a−b|²)/2.
            scattering +=
                weight * weight / (2.0 * n + 1.0) * 0.5 * (plus.norm_sqr() + minus.norm_sqr());
            extinction += weight * plus.re;
            back += minus * if at % 2 == 0 { -weight } else { weight };
        }
        let scale = TAU / (k * k);
        CrossSections {
            scattering: scale * scattering,
            extinction: scale * extinction,
            back: PI / (k * k) * back.norm_sqr(),
        }
    }
}

/// The amplitudes S1 (⊥), S2 (∥) as the matrix of [`SphericalScatterer`](super::SphericalScatterer).
pub(super) fn matrix((s1, s2): (Complex64, Complex64)) -> Jones {
    Jones::diagonal(s2, s1)
}

/// π_n + τ_n and π_n − τ_n for n = 1, 2, … at one angle.
#[derive(Clone, Debug)]
pub struct AngularFunctions {
    cos: f64,
    n: f64,
    before: f64,
    pi: f64,
}

impl AngularFunctions {
    /// At the cosine of the scattering angle.
    pub fn new(cos: f64) -> Self {
        Self { cos, n: 0.0, before: 0.0, pi: 1.0 }
    }
}

impl Iterator for AngularFunctions {
    type Item = (f64, f64);

    #[inline]
    fn next(&mut self) -> Option<(f64, f64)> {
        self.n += 1.0;
        let (n, pi) = (self.n, self.pi);
        let along = self.cos * pi;
        let tau = n * (along - self.before) - self.before;
        // π_{n+1} = cos π_n + (cos π_n − π_{n−1})(n+1)/n.
        self.pi = along + (along - self.before) * (n + 1.0) / n;
        self.before = pi;
        Some((pi + tau, pi - tau))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_angular_functions_are_the_printed_ones() {
        let c = 0.3f64;
        let got: Vec<_> = AngularFunctions::new(c).take(3).collect();
        let pi = [1.0, 3.0 * c, 1.5 * (5.0 * c * c - 1.0)];
        let tau = [c, 3.0 * (2.0 * c * c - 1.0), 1.5 * c * (15.0 * c * c - 11.0)];
        for n in 0..3 {
            assert!((got[n].0 - pi[n] - tau[n]).abs() < 1e-14);
            assert!((got[n].1 - pi[n] + tau[n]).abs() < 1e-14);
        }
    }

    #[test]
    fn forward_angular_functions_are_half_n_n_plus_1() {
        for (at, (up, down)) in AngularFunctions::new(1.0).take(50).enumerate() {
            let n = (at + 1) as f64;
            assert!((up - n * (n + 1.0)).abs() < 1e-12 * up && down.abs() < 1e-12 * up);
        }
    }
}
