//! Fourier integrals over a triangle, free of removable singularities.
//!
//! By the formula of Hermite and Genocchi, the mean of $e^{i a}$ over a triangle on which the phase
//! a is linear is twice the divided difference of the exponential at the three phases of the
//! corners; λ falls linearly from 1 at corner 0 to 0 at the others:
//!
//! $$ \langle e^{ia} \rangle = 2\,[i a_0, i a_1, i a_2]\exp \qquad (1) $$
//!
//! $$ \langle \lambda\,e^{ia} \rangle = 2\,[i a_0, i a_0, i a_1, i a_2]\exp \qquad (2) $$
//!
//! The closed forms of plateaus and pyramids are these differences written out, with a 0/0 on every
//! line normal to an edge.
//!
//! C. de Boor, *Divided differences*, Surveys in Approximation Theory 1, 46 (2005).

use num_complex::Complex64;

use super::sinc;

/// Mean of exp(i a) over a triangle with these phases at its corners. (1)
pub(super) fn flat(mut phases: [f64; 3]) -> Complex64 {
    phases.sort_by(f64::total_cmp);
    2.0 * difference(&phases)
}

/// The same with a weight that falls from 1 at the corner `top` to 0 at the corners `foot`. (2)
pub(super) fn tapered(top: f64, foot: [f64; 2]) -> Complex64 {
    let mut phases = [top, top, foot[0], foot[1]];
    phases.sort_by(f64::total_cmp);
    2.0 * difference(&phases)
}

/// Below this spread of phases the recursion would lose digits; the series needs 20 terms.
const CLOSE: f64 = 1.0;

/// Divided difference of the exponential at i times the ascending `phases`.
fn difference(phases: &[f64]) -> Complex64 {
    let n = phases.len();
    let (first, last) = (phases[0], phases[n - 1]);
    if n == 2 {
        return Complex64::cis(0.5 * (first + last)) * sinc(0.5 * (last - first));
    }
    if last - first < CLOSE {
        return series(phases);
    }
    (difference(&phases[1..]) - difference(&phases[..n - 1])) / Complex64::new(0.0, last - first)
}

/// Σ_k h_k/(k+n−1)! with the complete homogeneous polynomials h_k of the nodes about their mean.
fn series(phases: &[f64]) -> Complex64 {
    let n = phases.len();
    let mean = phases.iter().sum::<f64>() / n as f64;
    let mut factorial: f64 = (1..n).map(|j| j as f64).product();
    // h[j] is h_k of the first j + 1 nodes.
    let mut h = [1.0; 4];
    let mut sum = Complex64::new(1.0 / factorial, 0.0);
    let mut turn = Complex64::new(1.0, 0.0);
    for k in 1..20 {
        let mut fewer = 0.0;
        for (value, phase) in h.iter_mut().zip(phases) {
            *value = *value * (phase - mean) + fewer;
            fewer = *value;
        }
        factorial *= (k + n - 1) as f64;
        turn *= Complex64::i();
        sum += turn * (fewer / factorial);
    }
    sum * Complex64::cis(mean)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_phase_that_does_not_vary_gives_area_and_volume() {
        assert!((flat([0.0; 3]) - 1.0).norm() < 1e-15);
        assert!((tapered(0.0, [0.0; 2]) - 1.0 / 3.0).norm() < 1e-15);
    }

    #[test]
    fn series_and_recursion_meet() {
        // At a spread of 1 the recursion has lost one digit, the series none.
        for middle in [0.0, 0.1, 0.5, 0.999_999] {
            let below = [0.0, 0.0, middle, CLOSE - 1e-12];
            let above = [0.0, 0.0, middle, CLOSE + 1e-12];
            assert!((difference(&below) - difference(&above)).norm() < 1e-12);
        }
    }

    #[test]
    fn large_phases_agree_with_a_numerical_integral() {
        let (a, b, c) = (-3.0, 5.0, 11.0);
        // Midpoints of a fine subdivision of the triangle into equal triangles.
        let n = 400;
        let mut sum = Complex64::default();
        for i in 0..n {
            for j in 0..n - i {
                let at = |s: f64, t: f64| {
                    let (u, v) = ((i as f64 + s) / n as f64, (j as f64 + t) / n as f64);
                    Complex64::cis(a + (b - a) * u + (c - a) * v) * (1.0 - u - v)
                };
                sum += at(1.0 / 3.0, 1.0 / 3.0);
                if j + 1 < n - i {
                    sum += at(2.0 / 3.0, 2.0 / 3.0);
                }
            }
        }
        // The rule's own error falls with n²: (16/400)²/24 of a mean of 0.03.
        assert!((sum / (n * n) as f64 - tapered(a, [b, c])).norm() < 2e-5);
    }
}
