//! Riccati–Bessel functions ψ_n, ζ_n and their logarithmic derivatives.
//!
//! ψ_n(z) = z j_n(z) and ζ_n(z) = z h_n⁽¹⁾(z), so that ζ_n is an outgoing wave for exp(−iωt).
//! D1 = ψ'/ψ and the ratios ψ_n/ψ_{n−1} run downward, ζ upward. ψ without its factor e^{−iz} and
//! ζ without e^{iz}, with powers of two apart, overflow for no argument and no order.
//!
//! D. W. Mackowski, R. A. Altenkirch and M. P. Mengüç, Appl. Opt. 29, 1551 (1990); W. Yang, Appl.
//! Opt. 42, 1710 (2003).

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
        let inverse = above + ratio;
        // A vanishing ψ_{k−1} is as small as rounding makes it.
        above =
            ratio - if inverse == Complex64::ZERO { ratio * f64::EPSILON } else { inverse }.inv();
        if k <= n + 1 {
            d[k - 1] = above;
        }
    }
    d
}

/// A Riccati–Bessel function f_n(z) and f_n'(z) over a common power of two and of e^{iz}.
#[derive(Clone, Copy, Debug, Default)]
pub struct Scaled {
    /// f_n.
    pub value: Complex64,
    /// f_n'.
    pub slope: Complex64,
    /// The function is this times [`scale`] of the power.
    pub power: i32,
}

/// Powers of two are taken out in steps of 2⁴⁰⁰.
const STEP: i32 = 400;

/// 2^{400 `power`}, 0 if that underflows.
pub fn scale(power: i32) -> f64 {
    f64::from(STEP * power.clamp(-3, 2)).exp2()
}

/// ψ_n(z) e^{iz}, with the conjugates where Im z < 0, for n = 0 … `n` and z ≠ 0.
pub fn scaled_regular(n: usize, z: Complex64) -> Vec<Scaled> {
    if z.im < 0.0 {
        return conjugated(scaled_regular(n, z.conj()));
    }
    let ratio = ratios(n, z);
    // e^{iz} sin z and e^{iz} cos z.
    let square = (2.0 * Complex64::I * z).exp();
    let (sin, cos) = ((square - 1.0) / (2.0 * Complex64::I), (square + 1.0) * 0.5);
    let sin = if z.norm() < 0.1 { z.sin() * (Complex64::I * z).exp() } else { sin };
    let first =
        if sin.norm() < cos.norm() && z.norm() > 1.0 { sin / z - cos } else { sin * ratio[1] };
    climb(n, z, [sin, cos, first], |k, _, last| last * ratio[k])
}

/// ζ_n(z) e^{−iz}, with the conjugates where Im z < 0, for n = 0 … `n` and z ≠ 0.
pub fn scaled_outgoing(n: usize, z: Complex64) -> Vec<Scaled> {
    if z.im < 0.0 {
        return conjugated(scaled_outgoing(n, z.conj()));
    }
    let start = [-Complex64::I, Complex64::ONE, -Complex64::I / z - 1.0];
    climb(n, z, start, |k, before, last| last * ((2 * k - 1) as f64 / z) - before)
}

fn conjugated(mut functions: Vec<Scaled>) -> Vec<Scaled> {
    for f in &mut functions {
        (f.value, f.slope) = (f.value.conj(), f.slope.conj());
    }
    functions
}

/// f_0 … f_n from [f_0, f_0', f_1] and `next`, which gives f_k of f_{k−2} and f_{k−1}.
fn climb(
    n: usize,
    z: Complex64,
    [zeroth, slope, first]: [Complex64; 3],
    next: impl Fn(usize, Complex64, Complex64) -> Complex64,
) -> Vec<Scaled> {
    let mut out = vec![Scaled { value: zeroth, slope, power: 0 }];
    let (mut before, mut last, mut power) = (Complex64::ZERO, zeroth, 0);
    for k in 1..=n {
        (before, last) = (last, if k == 1 { first } else { next(k, before, last) });
        let size = before.norm().max(last.norm());
        let limit = f64::from(STEP / 2).exp2();
        if size > limit || (size < limit.recip() && size > 0.0) {
            let step = if size > limit { 1 } else { -1 };
            (before, last, power) = (before * scale(-step), last * scale(-step), power + step);
        }
        out.push(Scaled { value: last, slope: before - last * (k as f64 / z), power });
    }
    out
}

/// ψ_k(z)/ψ_{k−1}(z) for k = 1 … `n` + 1.
fn ratios(n: usize, z: Complex64) -> Vec<Complex64> {
    let mut ratio = vec![Complex64::ZERO; n + 2];
    let mut above = Complex64::ZERO;
    for k in (1..=start(n, z)).rev() {
        let leading = (2 * k + 1) as f64 / z;
        let inverse = leading - above;
        // A vanishing ψ_{k−1} is as small as rounding makes it; ψ_k follows from the next ratio.
        above = if inverse == Complex64::ZERO { leading * f64::EPSILON } else { inverse }.inv();
        if k <= n + 1 {
            ratio[k] = above;
        }
    }
    ratio
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
    let ratio = ratios(n, z);
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
    fn scaled_functions_have_the_wronskian_i() {
        // ψ ζ' − ψ' ζ = i, and both scales cancel; at multiples of π ψ_0 vanishes.
        let pi = std::f64::consts::PI;
        for z in [(1e-3, 0.0), (2.0 * pi, 0.0), (4.5, 2.0), (80.0, 300.0), (3.0, -2.0), (5.0, 1e-9)]
        {
            let z = Complex64::new(z.0, z.1);
            let i = if z.im < 0.0 { -Complex64::I } else { Complex64::I };
            for (psi, zeta) in scaled_regular(300, z).iter().zip(scaled_outgoing(300, z)) {
                let w = psi.value * zeta.slope - psi.slope * zeta.value;
                let w = w * scale(psi.power + zeta.power);
                assert!((w - i).norm() < 1e-12, "{z}: {w} {psi:?} {zeta:?}");
            }
        }
    }

    #[test]
    fn log_derivatives_are_slopes_over_values() {
        for z in [Complex64::new(0.7, 0.0), Complex64::new(5.0, 2.0), Complex64::new(80.0, 300.0)] {
            let psi = scaled_regular(40, z);
            for (n, d1) in log_derivatives(40, z, start(40, z)).into_iter().enumerate() {
                assert!((psi[n].slope / psi[n].value / d1 - 1.0).norm() < 1e-12, "{z} {n}");
            }
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
