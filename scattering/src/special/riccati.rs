//! Riccati–Bessel functions ψ_n, ζ_n and their logarithmic derivatives.
//!
//! ψ_n(z) = z j_n(z) and ζ_n(z) = z h_n⁽¹⁾(z), so that ζ_n is an outgoing wave for exp(−iωt).
//! D1 = ψ'/ψ runs downward, D3 = ζ'/ζ upward through the product ψζ, after D. W. Mackowski,
//! R. A. Altenkirch and M. P. Mengüç, Appl. Opt. 29, 1551 (1990): neither overflows for absorbing
//! arguments, and neither loses digits where n exceeds |z|.

use num_complex::Complex64;

/// An order above which the downward recurrence for D1(z) may start to be exact at `n` and below.
///
/// The error of the start dies as (ψ_start/ψ_n)², which is below 10⁻¹⁷ eight widths |z|^{1/3} of
/// the turning point above it.
pub fn start(n: usize, z: Complex64) -> usize {
    let turn = z.norm();
    n.max((turn + 8.0 * turn.cbrt()) as usize) + 16
}

/// D1_n(z) = ψ_n'(z)/ψ_n(z) for n = 0 … `n`, started with 0 at the order `from` > `n`.
pub fn log_derivatives(n: usize, z: Complex64, from: usize) -> Vec<Complex64> {
    let mut d = vec![Complex64::ZERO; n + 1];
    let mut above = Complex64::ZERO;
    for k in (1..=from).rev() {
        let ratio = k as f64 / z;
        above = ratio - (above + ratio).inv();
        if k <= n + 1 {
            d[k - 1] = above;
        }
    }
    d
}

/// D3_n(z) = ζ_n'(z)/ζ_n(z) for as many orders as `d1` = D1(z) holds.
pub fn log_derivatives_outgoing(z: Complex64, d1: &[Complex64]) -> Vec<Complex64> {
    // ψ_0 ζ_0 = (1 − e^{2iz})/2, D3_0 = i.
    let mut product = 0.5 * (1.0 - (2.0 * Complex64::I * z).exp());
    let mut d3 = vec![Complex64::I; d1.len()];
    for n in 1..d1.len() {
        let ratio = n as f64 / z;
        product *= (ratio - d3[n - 1]) / (d1[n] + ratio);
        d3[n] = d1[n] + Complex64::I / product;
    }
    d3
}

/// ψ_n(x) and χ_n(x) with ζ = ψ − iχ, for n = 0 … `n` and real x > 0.
///
/// ψ follows from its ratios ψ_n/ψ_{n−1}, which run downward, and from sin x or, where that is
/// small, from ψ_1; χ runs upward from cos x.
pub fn real(n: usize, x: f64) -> (Vec<f64>, Vec<f64>) {
    let mut ratio = vec![0.0; n + 2];
    let mut above = 0.0;
    for k in (1..=start(n, x.into())).rev() {
        above = 1.0 / ((2 * k + 1) as f64 / x - above);
        if k <= n + 1 {
            ratio[k] = above;
        }
    }
    let (sin, cos) = x.sin_cos();
    let mut psi = vec![sin; n + 1];
    let mut chi = vec![cos; n + 1];
    for k in 1..=n {
        psi[k] = if k == 1 && sin.abs() < cos.abs() && x > 1.0 {
            sin / x - cos
        } else {
            psi[k - 1] * ratio[k]
        };
        chi[k] = match k {
            1 => cos / x + sin,
            _ => (2 * k - 1) as f64 / x * chi[k - 1] - chi[k - 2],
        };
    }
    (psi, chi)
}

/// ψ_k(z) for k = 0 … `n` and z ≠ 0; the ratios ψ_k/ψ_{k−1} run downward.
pub fn regular(n: usize, z: Complex64) -> Vec<Complex64> {
    let mut ratio = vec![Complex64::ZERO; n + 2];
    let mut above = Complex64::ZERO;
    for k in (1..=start(n, z)).rev() {
        above = ((2 * k + 1) as f64 / z - above).inv();
        if k <= n + 1 {
            ratio[k] = above;
        }
    }
    let (sin, cos) = (z.sin(), z.cos());
    let mut psi = vec![sin; n + 1];
    for k in 1..=n {
        psi[k] = if k == 1 && sin.norm() < cos.norm() && z.norm() > 1.0 {
            sin / z - cos
        } else {
            psi[k - 1] * ratio[k]
        };
    }
    psi
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_wronskian_of_psi_and_chi_is_one() {
        // ψ_n χ_{n−1} − ψ_{n−1} χ_n = 1 for these signs, however small ψ is.
        for x in [1e-3, 0.1, 1.0, 3.0, std::f64::consts::PI, 57.1, 1000.3] {
            let (psi, chi) = real(20, x);
            for n in 1..=20 {
                let w = psi[n - 1] * chi[n] - psi[n] * chi[n - 1];
                assert!((w - 1.0).abs() < 1e-12, "{x} {n}: {w}");
            }
        }
    }

    #[test]
    fn first_log_derivatives_are_the_closed_forms() {
        for z in [Complex64::new(0.7, 0.0), Complex64::new(5.0, 2.0), Complex64::new(80.0, 300.0)] {
            let d1 = log_derivatives(3, z, start(3, z));
            let d3 = log_derivatives_outgoing(z, &d1);
            // ψ_0 = sin z, and cos z/sin z = i(1 + e^{2iz})/(e^{2iz} − 1).
            let e = (2.0 * Complex64::I * z).exp();
            let cot = Complex64::I * (e + 1.0) / (e - 1.0);
            assert!((d1[0] - cot).norm() < 1e-13 * cot.norm());
            // ζ_1 ∝ e^{iz}(1/z + … ): ζ_1'/ζ_1 = i − 1/(z(1 − iz))·… from h_1 = −e^{iz}(z + i)/z².
            let expected = Complex64::I + 1.0 / (z + Complex64::I) - 1.0 / z;
            assert!((d3[1] - expected).norm() < 1e-12 * expected.norm());
        }
    }

    #[test]
    fn complex_psi_is_the_real_one_and_has_the_log_derivative() {
        for x in [0.1, 1.0, std::f64::consts::PI, 20.0] {
            let (real, _) = real(12, x);
            for (a, b) in regular(12, x.into()).iter().zip(real) {
                assert!((a - b).norm() < 1e-13 * b.abs(), "{x}");
            }
        }
        let z = Complex64::new(3.0, 2.0);
        let (psi, d1) = (regular(8, z), log_derivatives(8, z, start(8, z)));
        for n in 1..=8 {
            let slope = psi[n - 1] - psi[n] * n as f64 / z;
            assert!((slope / psi[n] - d1[n]).norm() < 1e-12 * d1[n].norm(), "{n}");
        }
    }
}
