//! Mie coefficients of a sphere of any number of concentric layers.
//!
//! With the logarithmic derivatives D1 of ψ and D3 of ζ, the layer l of relative index m_l from
//! x_{l−1} to x_l passes the derivatives H of its inner face to its outer one,
//!
//! $$ H_l = \frac{G_2 D_1(m_l x_l) - Q\,G_1 D_3(m_l x_l)}{G_2 - Q\,G_1}, \qquad
//!    Q = \frac{\psi(m_l x_{l-1})/\zeta(m_l x_{l-1})}{\psi(m_l x_l)/\zeta(m_l x_l)} $$
//!
//! where G_i = m_l H_{l−1} − m_{l−1} D_i(m_l x_{l−1}) for a_n (i = 1 with D1, 2 with D3) and with
//! m_l and m_{l−1} exchanged for b_n; H_1 = D1(m_1 x_1). Outside
//!
//! $$ a_n = \frac{(H/m + n/x)\psi_n - \psi_{n-1}}{(H/m + n/x)\zeta_n - \zeta_{n-1}}, \qquad
//!    b_n = \frac{(mH + n/x)\psi_n - \psi_{n-1}}{(mH + n/x)\zeta_n - \zeta_{n-1}} $$
//!
//! One layer is the homogeneous sphere. Q is a ratio that neither overflows nor loses digits for
//! thick absorbing layers.
//!
//! W. Yang, Appl. Opt. 42, 1710 (2003); C. F. Bohren and D. R. Huffman, *Absorption and
//! Scattering of Light by Small Particles* (Wiley, 1983), chapter 4 and 8.1.

use num_complex::Complex64;

use crate::special::riccati;

/// A layer: its index relative to the medium outside, and the size parameter of its outer face.
pub type SphereShell = (Complex64, f64);

/// Derivatives (H^a_n, H^b_n) at the outer face of the layers passed so far.
type FaceDerivatives = Vec<(Complex64, Complex64)>;

/// (a_n, b_n) of the homogeneous sphere `layer` for n = 1 … `terms`, with D1 started at the order
/// `from` > `terms`.
pub fn homogeneous(layer: SphereShell, terms: usize, from: usize) -> Vec<(Complex64, Complex64)> {
    outside(layer, &core(layer, terms, from))
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
            None => core(layer, terms, riccati::start(terms, layer.0 * layer.1)),
            Some((inner, _)) if inner.1 >= layer.1 => continue,
            Some((inner, faces)) => shell(inner, layer, &faces),
        };
        inside = Some((layer, faces));
    }
    let (outermost, faces) = inside.expect("a sphere has a layer");
    outside(outermost, &faces)
}

fn core((m, x): SphereShell, terms: usize, from: usize) -> FaceDerivatives {
    riccati::log_derivatives(terms, m * x, from).into_iter().map(|d| (d, d)).collect()
}

fn derivatives(terms: usize, z: Complex64) -> Vec<Complex64> {
    riccati::log_derivatives(terms, z, riccati::start(terms, z))
}

/// H at the outer face of the shell `layer` around `inner`.
fn shell(inner: SphereShell, (m, x): SphereShell, faces: &FaceDerivatives) -> FaceDerivatives {
    let (near, far) = (m * inner.1, m * x);
    let terms = faces.len() - 1;
    let (d1_near, d1_far) = (derivatives(terms, near), derivatives(terms, far));
    let d3_near = riccati::log_derivatives_outgoing(near, &d1_near);
    let d3_far = riccati::log_derivatives_outgoing(far, &d1_far);
    let mut q = first_ratio(near, far);
    let mut out = faces.clone();
    for n in 1..=terms {
        let order = n as f64;
        // ψ_n/ψ_{n−1} = z/(zD1_n + n) and ζ_n/ζ_{n−1} = (n − zD3_{n−1})/z.
        q *= (inner.1 / x).powi(2)
            * ((far * d1_far[n] + order) / (near * d1_near[n] + order))
            * ((order - far * d3_far[n - 1]) / (order - near * d3_near[n - 1]));
        let pass = |h: Complex64, with_h: Complex64, with_d: Complex64| {
            let g1 = with_h * h - with_d * d1_near[n];
            let g2 = with_h * h - with_d * d3_near[n];
            (g2 * d1_far[n] - q * g1 * d3_far[n]) / (g2 - q * g1)
        };
        let (a, b) = faces[n];
        out[n] = (pass(a, m, inner.0), pass(b, inner.0, m));
    }
    out
}

/// Q_0 = (ψ_0/ζ_0)(near)/(ψ_0/ζ_0)(far), with ψ_0/ζ_0 = (1 − e^{−2iz})/2.
fn first_ratio(near: Complex64, far: Complex64) -> Complex64 {
    // e^{−2iz} grows inwards to outwards: both terms times e^{2i far}.
    let phase = |z: Complex64| (2.0 * Complex64::I * z).exp();
    (phase(far) - phase(far - near)) / (phase(far) - 1.0)
}

fn outside((m, x): SphereShell, faces: &FaceDerivatives) -> Vec<(Complex64, Complex64)> {
    let (psi, chi) = riccati::real(faces.len() - 1, x);
    let coefficient = |n: usize, y: Complex64| {
        let factor = y + n as f64 / x;
        let regular = factor * psi[n] - psi[n - 1];
        let irregular = factor * chi[n] - chi[n - 1];
        regular / (regular - Complex64::I * irregular)
    };
    (1..faces.len())
        .map(|n| (coefficient(n, faces[n].0 / m), coefficient(n, faces[n].1 * m)))
        .collect()
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
