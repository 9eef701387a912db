//! Homogeneous sphere of an optically active material.
//!
//! The material has the indices m_L and m_R (relative to the medium) for left and right circular
//! light; 1/m = ½(1/m_L + 1/m_R). With
//! W(J) = mψ(m_J x)ζ'(x) − ζ(x)ψ'(m_J x), V(J) = ψ(m_J x)ζ'(x) − mζ(x)ψ'(m_J x) and A, B the same
//! with ψ in place of ζ,
//!
//! $$ a_n = \frac{V_R A_L + V_L A_R}{D}, \quad b_n = \frac{W_L B_R + W_R B_L}{D}, \quad
//!    c_n = i\,\frac{W_R A_L - W_L A_R}{D}, \quad D = W_L V_R + V_L W_R $$
//!
//! c_n mixes the polarizations: S3 = −S4 = Σ (2n+1)/(n(n+1)) c_n(π_n + τ_n).
//!
//! C. F. Bohren, Chem. Phys. Lett. 29, 458 (1974); C. F. Bohren and D. R. Huffman, *Absorption and
//! Scattering of Light by Small Particles* (Wiley, 1983), 8.3.

use num_complex::Complex64;

use super::{
    FREE_SPACE, HostMedium, Scatterer, SphericalScatterer,
    series::{self, AngularFunctions, MieSeries},
};
use crate::{
    Jones,
    spec::{Class, Laws, Parameter, Spec},
    special::riccati,
};

/// Name, parameters and constructor of an [`OpticallyActive`] sphere.
pub const SPEC: Spec<dyn Scatterer> = Spec {
    class: Class {
        name: "Optically_Active_Sphere_Scatterer",
        parent: "Free_Space_Scatterer",
        summary: "Sphere with other indices for left and right circular light",
        equation: "Mie series with a_n, b_n and c_n; S3 = -S4 = sum (2n+1)/(n(n+1)) c_n (pi_n + tau_n)",
        source: "bohren-1974 bohren-huffman-1983",
        params: &[
            FREE_SPACE,
            &[
                Parameter::index("materialleft", (1.59, 0.0), "Index for left circular light"),
                Parameter::index("materialright", (1.59, 0.0), "Index for right circular light"),
                Parameter::number("radius", 1.0, "um", "Radius"),
            ],
        ],
        laws: Laws::NONE,
    },
    build: |node| {
        let around = HostMedium::read(node)?;
        let left = around.relative_index(node, "materialleft")?;
        let right = around.relative_index(node, "materialright")?;
        let radius = around.radius(node, &[left, right])?;
        let terms = series::terms_for(node, around.wave_number() * radius);
        Ok(Box::new(OpticallyActive::new(around, left, right, radius, terms)))
    },
};

/// A sphere of an optically active material.
#[derive(Clone, Debug)]
pub struct OpticallyActive {
    around: HostMedium,
    series: MieSeries,
    /// (2n+1)/(n(n+1)) c_n, n from 1.
    mixing: Vec<Complex64>,
}

impl OpticallyActive {
    fn new(
        around: HostMedium,
        left: Complex64,
        right: Complex64,
        radius: f64,
        terms: usize,
    ) -> Self {
        let x = around.wave_number() * radius;
        let (mut diagonal, mut mixing) = (Vec::new(), Vec::new());
        for (at, [a, b, c]) in coefficients(left, right, x, terms).enumerate() {
            let n = (at + 1) as f64;
            diagonal.push((a, b));
            mixing.push(c * ((2.0 * n + 1.0) / (n * (n + 1.0))));
        }
        Self { around, series: MieSeries::new(&diagonal), mixing }
    }
}

/// (a_n, b_n, c_n), n from 1, with every ψ(m_J x) divided out.
fn coefficients(
    left: Complex64,
    right: Complex64,
    x: f64,
    terms: usize,
) -> impl Iterator<Item = [Complex64; 3]> {
    let m = 2.0 / (left.inv() + right.inv());
    let derivatives =
        |j: Complex64| riccati::log_derivatives(terms, j * x, riccati::start(terms, j * x));
    let (d_left, d_right) = (derivatives(left), derivatives(right));
    let (psi, chi) = riccati::real(terms, x);
    (1..=terms).map(move |n| {
        // f' = f_{n−1} − (n/x) f_n holds for ψ, χ and so for ζ = ψ − iχ.
        let slope = |f: &[f64]| f[n - 1] - n as f64 / x * f[n];
        let zeta = Complex64::new(psi[n], -chi[n]);
        let (psi_slope, zeta_slope) = (slope(&psi), Complex64::new(slope(&psi), -slope(&chi)));
        let (l, r) = (d_left[n], d_right[n]);
        let (w, v) = (|d| m * zeta_slope - zeta * d, |d| zeta_slope - m * zeta * d);
        let (a, b) = (|d| m * psi_slope - psi[n] * d, |d| psi_slope - m * psi[n] * d);
        let (w_l, w_r, v_l, v_r) = (w(l), w(r), v(l), v(r));
        let (a_l, a_r, b_l, b_r) = (a(l), a(r), b(l), b(r));
        let d = w_l * v_r + v_l * w_r;
        [
            (v_r * a_l + v_l * a_r) / d,
            (w_l * b_r + w_r * b_l) / d,
            Complex64::I * (w_r * a_l - w_l * a_r) / d,
        ]
    })
}

impl SphericalScatterer for OpticallyActive {
    fn surroundings(&self) -> &HostMedium {
        &self.around
    }

    fn amplitudes(&self, cos: f64) -> Jones {
        let (s1, s2) = self.series.amplitudes(cos);
        let s3: Complex64 =
            self.mixing.iter().zip(AngularFunctions::new(cos)).map(|(c, (up, _))| c * up).sum();
        Jones { ss: s2, ps: s3, sp: -s3, pp: s1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Mode, ParameterNode};

    const AROUND: HostMedium = HostMedium { lambda: 0.5, medium: Complex64::new(1.33, 0.0) };

    #[test]
    fn equal_indices_are_the_inactive_sphere() {
        let m = Complex64::new(1.2, 0.01);
        let node = ParameterNode::with_defaults(&SPEC.class, Mode::Sound);
        let active = OpticallyActive::new(AROUND, m, m, 0.4, 30);
        let mie = super::super::mie::Mie::homogeneous(&node, AROUND, m, 0.4);
        for cos in [-1.0, 0.2, 0.9] {
            let (a, b) = (active.amplitudes(cos), mie.amplitudes(cos));
            assert!((a.ss - b.ss).norm() + (a.pp - b.pp).norm() < 1e-13 * b.pp.norm().max(1.0));
            assert!(a.ps.norm() < 1e-15 && a.sp.norm() < 1e-15);
        }
    }

    #[test]
    fn exchanged_indices_turn_the_other_way() {
        let (l, r) = (Complex64::new(1.2, 0.01), Complex64::new(1.23, 0.0));
        let a = OpticallyActive::new(AROUND, l, r, 0.4, 30).amplitudes(0.3);
        let b = OpticallyActive::new(AROUND, r, l, 0.4, 30).amplitudes(0.3);
        assert!((a.ps + b.ps).norm() < 1e-14 && a.ps.norm() > 1e-3);
        assert!((a.ss - b.ss).norm() < 1e-13);
    }
}
