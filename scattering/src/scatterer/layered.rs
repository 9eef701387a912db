//! Mie coefficients of a sphere of any number of concentric layers.
//!
//! The radial function of a multipole in the layer l of relative index m_l, from x_{l−1} to x_l, is
//! a combination of ψ_n and ζ_n of m_l x. With its value v and slope u at the inner face, as pairs
//! so that either may be zero, the pair at the outer face is
//!
//! $$ \begin{pmatrix} u_l \\ v_l \end{pmatrix} =
//!    G_\zeta \begin{pmatrix} \psi_n' \\ \psi_n \end{pmatrix}(m_l x_l) -
//!    G_\psi \begin{pmatrix} \zeta_n' \\ \zeta_n \end{pmatrix}(m_l x_l), \qquad
//!    G_f = m_l u_{l-1} f(m_l x_{l-1}) - m_{l-1} v_{l-1} f'(m_l x_{l-1}) $$
//!
//! for a_n, and with m_l and m_{l−1} exchanged for b_n. The core has (ψ_n', ψ_n). Outside
//!
//! $$ a_n = \frac{(u/m + nv/x)\psi_n - v\psi_{n-1}}{(u/m + nv/x)\zeta_n - v\zeta_{n-1}}, \qquad
//!    b_n = \frac{(mu + nv/x)\psi_n - v\psi_{n-1}}{(mu + nv/x)\zeta_n - v\zeta_{n-1}} $$
//!
//! One layer is the homogeneous sphere. The functions carry their powers of two and of e^{iz}
//! separately, so that thick absorbing layers neither overflow nor lose digits, and no quotient
//! is taken of a function that can vanish.
//!
//! W. Yang, Appl. Opt. 42, 1710 (2003); C. F. Bohren and D. R. Huffman, *Absorption and
//! Scattering of Light by Small Particles* (Wiley, 1983), chapter 4 and 8.1.

use num_complex::Complex64;

use crate::special::riccati::{self, Scaled};

/// A layer: its index relative to the medium outside, and the size parameter of its outer face.
pub type SphereShell = (Complex64, f64);

/// Slope u and value v of a radial function, up to a common factor.
type SlopeAndValue = (Complex64, Complex64);

/// The pairs for a_n and for b_n at the outer face of the layers passed so far, by n.
type FaceDerivatives = Vec<(SlopeAndValue, SlopeAndValue)>;

/// (a_n, b_n) of the homogeneous sphere `layer` for n = 1 … `terms`, with ψ'/ψ started at the
/// order `from` > `terms`.
pub fn homogeneous(layer: SphereShell, terms: usize, from: usize) -> Vec<(Complex64, Complex64)> {
    let slopes = riccati::log_derivatives(terms, layer.0 * layer.1, from);
    let pair = |slope: Complex64| (slope, Complex64::ONE);
    outside(layer, &slopes.into_iter().map(|d| (pair(d), pair(d))).collect())
}

/// (a_n, b_n) for n = 1 … `terms`; layers from the inside out, empty ones are passed over.
///
/// # Panics
///
/// If no layer has a positive outer size parameter.
pub fn coefficients(layers: &[SphereShell], terms: usize) -> Vec<(Complex64, Complex64)> {
    let mut inside: Option<(SphereShell, FaceDerivatives)> = None;
    for &layer in layers.iter().filter(|layer| layer.1 > 0.0) {
        let faces = match inside {
            None => core(layer, terms),
            Some((inner, _)) if inner.1 >= layer.1 => continue,
            Some((inner, faces)) => shell(inner, layer, &faces),
        };
        inside = Some((layer, faces));
    }
    let (outermost, faces) = inside.expect("a sphere has a layer");
    outside(outermost, &faces)
}

fn core((m, x): SphereShell, terms: usize) -> FaceDerivatives {
    let psi = riccati::scaled_regular(terms, m * x);
    psi.iter().map(|f| (f.slope, f.value)).map(|pair| (pair, pair)).collect()
}

/// The pairs at the outer face of the shell `layer` around `inner`.
fn shell(inner: SphereShell, (m, x): SphereShell, faces: &FaceDerivatives) -> FaceDerivatives {
    let (near, far) = (m * inner.1, m * x);
    let terms = faces.len() - 1;
    let (psi_near, psi_far) =
        (riccati::scaled_regular(terms, near), riccati::scaled_regular(terms, far));
    let (zeta_near, zeta_far) =
        (riccati::scaled_outgoing(terms, near), riccati::scaled_outgoing(terms, far));
    // ψ comes without e^{∓iz} and ζ without e^{±iz}, the signs such that the second one decays.
    let sign = if far.im < 0.0 { -2.0 } else { 2.0 };
    let decay = (sign * Complex64::I * (far - near)).exp();
    let pass = |n: usize, (u, v): SlopeAndValue, with_u: Complex64, with_v: Complex64| {
        let g = |f: &Scaled| with_u * u * f.value - with_v * v * f.slope;
        let (psi, zeta) = (&psi_far[n], &zeta_far[n]);
        let powers = psi_near[n].power + zeta.power - psi.power - zeta_near[n].power;
        let (g_zeta, g_psi) = (g(&zeta_near[n]), g(&psi_near[n]) * decay * riccati::scale(powers));
        unit((g_zeta * psi.slope - g_psi * zeta.slope, g_zeta * psi.value - g_psi * zeta.value))
    };
    let each = |n: usize| {
        let (a, b) = faces[n];
        (pass(n, a, m, inner.0), pass(n, b, inner.0, m))
    };
    (0..=terms).map(each).collect()
}

/// The pair over the larger of its sizes.
fn unit((u, v): SlopeAndValue) -> SlopeAndValue {
    let size = u.norm().max(v.norm()).recip();
    if size.is_finite() { (u * size, v * size) } else { (u, v) }
}

fn outside((m, x): SphereShell, faces: &FaceDerivatives) -> Vec<(Complex64, Complex64)> {
    /// Size of an irregular function at which a coefficient vanishes.
    const NOTHING: f64 = 1e160;
    let (psi, chi) = riccati::real(faces.len() - 1, x);
    let coefficient = |n: usize, u: Complex64, v: Complex64| {
        if chi[n].is_nan() || chi[n].abs() > NOTHING {
            return Complex64::ZERO;
        }
        let factor = u + v * (n as f64 / x);
        let regular = factor * psi[n] - v * psi[n - 1];
        let irregular = factor * chi[n] - v * chi[n - 1];
        regular / (regular - Complex64::I * irregular)
    };
    let each = |n: usize| {
        let (a, b) = faces[n];
        (coefficient(n, a.0 / m, a.1), coefficient(n, b.0 * m, b.1))
    };
    (1..faces.len()).map(each).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn worst(a: &[(Complex64, Complex64)], b: &[(Complex64, Complex64)]) -> f64 {
        a.iter().zip(b).map(|(p, q)| (p.0 - q.0).norm().max((p.1 - q.1).norm())).fold(0.0, f64::max)
    }

    const INDICES: [Complex64; 4] = [
        Complex64::new(1.5, 0.0),
        Complex64::new(0.2, 3.5),
        Complex64::new(4.0, 2.0),
        Complex64::new(1.33, 1e-5),
    ];

    #[test]
    fn layers_of_one_material_are_one_sphere() {
        for m in INDICES {
            for x in [0.05, 3.0, 60.0] {
                let layers = [(m, 0.3 * x), (m, 0.3 * x), (m, 0.9 * x), (m, x)];
                let n = 12;
                // The start of the recurrences differs with the arguments: rounding only.
                assert!(worst(&coefficients(&layers, n), &coefficients(&[(m, x)], n)) < 1e-12);
            }
        }
    }

    #[test]
    fn a_shell_of_the_medium_is_not_there() {
        for m in INDICES {
            let shell = coefficients(&[(m, 2.0), (Complex64::ONE, 5.0)], 8);
            assert!(worst(&shell, &coefficients(&[(m, 2.0)], 8)) < 1e-12, "{m}");
        }
    }

    #[test]
    fn an_opaque_shell_hides_the_core() {
        let metal = Complex64::new(0.5, 7.0);
        let hidden = coefficients(&[(Complex64::new(1.5, 0.0), 10.0), (metal, 400.0)], 300);
        assert!(worst(&hidden, &coefficients(&[(metal, 400.0)], 300)) < 1e-12);
    }

    #[test]
    fn lossless_spheres_scatter_all_they_take_from_the_beam() {
        let layers = [(Complex64::new(1.7, 0.0), 4.0), (Complex64::new(1.2, 0.0), 6.0)];
        for (a, b) in coefficients(&layers, 12) {
            assert!((a.re - a.norm_sqr()).abs() < 1e-14 && (b.re - b.norm_sqr()).abs() < 1e-14);
        }
    }
}
