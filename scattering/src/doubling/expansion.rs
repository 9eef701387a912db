//! A phase matrix as a series of Wigner functions of the scattering angle.
//!
//! With Q = I_∥ − I_⊥ of the scattering plane the phase matrix times 4π has the elements
//! a₁ (00), a₂ (11), a₃ (22), a₄ (33), b₁ (01 and 10), b₂ (23 and −32). With c = cos Θ
//!
//! $$ \alpha_{1,l} = \tfrac{2l+1}2\int a_1 d^l_{00}\,dc, \quad
//!    \beta_{1,l} = \tfrac{2l+1}2\int b_1 d^l_{02}\,dc, \quad
//!    (\alpha_2\pm\alpha_3)_l = \tfrac{2l+1}2\int (a_2\pm a_3)\,d^l_{2,\pm2}\,dc $$
//!
//! α₄ as α₁, β₂ as β₁; α₁,₀ = 1. The forward peak beyond the order L is cut (δ–M): with
//! f = α₁,L+1/(2L+3), α → (α − f(2l+1))/(1 − f), β → β/(1 − f), and the fraction f of the scattered
//! light is treated as unscattered.
//!
//! J. W. Hovenier, C. van der Mee and H. Domke, *Transfer of Polarized Light in Planetary
//! Atmospheres* (Kluwer, 2004), 2.8; W. J. Wiscombe, J. Atmos. Sci. 34, 1408 (1977).

use super::wigner::wigner_d;
use crate::special::gauss;

/// The six functions of the scattering angle: a₁, a₂, a₃, a₄, b₁, b₂.
pub type PhaseElements = [f64; 6];

/// The fewest points of an integral over cos Θ.
const FEWEST: usize = 160;
/// The most points: enough for spheres of x = 2000.
const MOST: usize = 10_240;
/// Coefficients that change by less are final.
const FINAL: f64 = 1e-13;

/// Coefficients for l = 0 … L.
#[derive(Clone, Debug)]
pub struct PhaseExpansion {
    /// α₁, α₂, α₃, α₄, β₁, β₂ of every l.
    pub terms: Vec<PhaseElements>,
}

impl PhaseExpansion {
    /// That of the phase matrix with these elements, divided by its α₁,₀, up to l = `top`; and α₁,₀.
    ///
    /// The number of points doubles until no coefficient moves by more than 10⁻¹³ of 2l + 1.
    pub fn converged(elements: impl Fn(f64) -> PhaseElements, top: usize) -> (Self, f64) {
        let mut points = FEWEST.max(2 * top);
        let mut found = Self::integrated(&elements, top, points);
        while points < MOST {
            points *= 2;
            let finer = Self::integrated(&elements, top, points);
            let moved = found.largest_change(&finer);
            found = finer;
            if moved < FINAL {
                break;
            }
        }
        let whole = found.terms[0][0];
        (found.normalized(), whole)
    }

    /// By Gauss–Legendre quadrature with `points` points.
    pub fn integrated(elements: impl Fn(f64) -> PhaseElements, top: usize, points: usize) -> Self {
        let mut terms = vec![[0.0; 6]; top + 1];
        for (c, w) in gauss::legendre(points, -1.0, 1.0) {
            let [a1, a2, a3, a4, b1, b2] = elements(c).map(|x| 0.5 * w * x);
            let [d00, d02, d22, d2m] =
                [(0, 0), (0, 2), (2, 2), (2, -2)].map(|(m, n)| wigner_d(m, n, c, top));
            for (l, term) in terms.iter_mut().enumerate() {
                let size = (2 * l + 1) as f64;
                let plus = (a2 + a3) * d22[l];
                let minus = (a2 - a3) * d2m[l];
                let here = [
                    a1 * d00[l],
                    0.5 * (plus + minus),
                    0.5 * (plus - minus),
                    a4 * d00[l],
                    b1 * d02[l],
                    b2 * d02[l],
                ];
                for (sum, x) in term.iter_mut().zip(here) {
                    *sum += size * x;
                }
            }
        }
        Self { terms }
    }

    /// Rayleigh scattering.
    pub fn rayleigh() -> Self {
        Self::integrated(rayleigh, 2, 8)
    }

    /// Henyey and Greenstein's scalar function, which depolarizes, up to l = `top`.
    pub fn henyey_greenstein(g: f64, top: usize) -> Self {
        let term = |l: usize| [(2 * l + 1) as f64 * g.powi(l as i32), 0.0, 0.0, 0.0, 0.0, 0.0];
        Self { terms: (0..=top).map(term).collect() }
    }

    /// The mean of `parts`, each with its weight; the weights need not add up to 1.
    pub fn mean(parts: &[(f64, &Self)]) -> Self {
        let total: f64 = parts.iter().map(|(weight, _)| weight).sum();
        let longest = parts.iter().map(|(_, part)| part.terms.len()).max().unwrap_or(1);
        let mut terms = vec![[0.0; 6]; longest];
        for (weight, part) in parts {
            for (sum, term) in terms.iter_mut().zip(&part.terms) {
                for (s, x) in sum.iter_mut().zip(term) {
                    *s += weight / total * x;
                }
            }
        }
        Self { terms }
    }

    /// The series cut after l = `top`, and the fraction f of light that is treated as unscattered.
    pub fn truncated(&self, top: usize) -> (Self, f64) {
        let f = self.terms.get(top + 1).map_or(0.0, |term| term[0] / (2 * top + 3) as f64);
        let cut = |(l, term): (usize, &PhaseElements)| {
            let [a1, a2, a3, a4, b1, b2] = *term;
            let peak = f * (2 * l + 1) as f64;
            let peak_22 = if l >= 2 { peak } else { 0.0 };
            [a1 - peak, a2 - peak_22, a3 - peak_22, a4 - peak, b1, b2].map(|x| x / (1.0 - f))
        };
        (Self { terms: self.terms.iter().take(top + 1).enumerate().map(cut).collect() }, f)
    }

    /// The mean cosine of the scattering angle.
    pub fn asymmetry(&self) -> f64 {
        self.terms.get(1).map_or(0.0, |term| term[0] / 3.0)
    }

    /// The six functions at cos Θ = `c`.
    pub fn at_cosine(&self, c: f64) -> PhaseElements {
        let top = self.terms.len() - 1;
        let [d00, d02, d22, d2m] =
            [(0, 0), (0, 2), (2, 2), (2, -2)].map(|(m, n)| wigner_d(m, n, c, top));
        let mut sum = [0.0; 6];
        for (l, [a1, a2, a3, a4, b1, b2]) in self.terms.iter().enumerate() {
            let (plus, minus) = ((a2 + a3) * d22[l], (a2 - a3) * d2m[l]);
            let here = [
                a1 * d00[l],
                0.5 * (plus + minus),
                0.5 * (plus - minus),
                a4 * d00[l],
                b1 * d02[l],
                b2 * d02[l],
            ];
            for (s, x) in sum.iter_mut().zip(here) {
                *s += x;
            }
        }
        sum
    }

    fn normalized(mut self) -> Self {
        let whole = self.terms[0][0];
        for x in self.terms.iter_mut().flatten() {
            *x /= whole;
        }
        self
    }

    /// The largest change of a coefficient, over 2l + 1.
    fn largest_change(&self, other: &Self) -> f64 {
        let mut largest: f64 = 0.0;
        for (l, (a, b)) in self.terms.iter().zip(&other.terms).enumerate() {
            let size = (2 * l + 1) as f64;
            for (x, y) in a.iter().zip(b) {
                largest = largest.max((x - y).abs() / size);
            }
        }
        largest / other.terms[0][0].abs().max(f64::MIN_POSITIVE)
    }
}

/// The elements of Rayleigh's phase matrix.
fn rayleigh(c: f64) -> PhaseElements {
    let a1 = 0.75 * (1.0 + c * c);
    [a1, a1, 1.5 * c, 1.5 * c, -0.75 * (1.0 - c * c), 0.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rayleigh_scattering_has_three_orders() {
        let terms = PhaseExpansion::rayleigh().terms;
        let expected = [
            [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 1.5, 0.0, 0.0],
            [0.5, 3.0, 0.0, 0.0, -(1.5f64.sqrt()), 0.0],
        ];
        for (term, want) in terms.iter().flatten().zip(expected.iter().flatten()) {
            assert!((term - want).abs() < 1e-14, "{terms:?}");
        }
    }

    #[test]
    fn a_series_gives_back_its_phase_matrix() {
        let series = PhaseExpansion::integrated(rayleigh, 6, 20);
        for c in [-1.0, -0.4, 0.3, 1.0] {
            for (a, b) in series.at_cosine(c).iter().zip(rayleigh(c)) {
                assert!((a - b).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn the_cut_series_keeps_the_mean_cosine_of_all_light() {
        let whole = PhaseExpansion::henyey_greenstein(0.8, 40);
        let (cut, f) = whole.truncated(16);
        assert!((f + (1.0 - f) * cut.asymmetry() - 0.8).abs() < 1e-14);
        assert!((cut.terms[0][0] - 1.0).abs() < 1e-15);
    }
}
