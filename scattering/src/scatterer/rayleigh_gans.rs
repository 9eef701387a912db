//! Sphere of nearly the index of its medium: every volume element scatters the incident wave.
//!
//! $$ S_1 = -2i\left(\frac{x}{u}\right)^3 (m-1)(\sin u - u\cos u), \qquad
//!    S_2 = S_1\cos\theta, \qquad u = 2x\sin\frac{\theta}{2} $$
//!
//! for |m − 1| ≪ 1 and x|m − 1| ≪ 1. The total cross-section is
//! C_sca = πr²|m−1|²{5/2 + 2x² − sin 4x/4x − 7(1−cos 4x)/16x² + (1/2x² − 2)[γ + ln 4x − Ci(4x)]}.
//! `--compat` turns the sign of i.
//!
//! H. C. van de Hulst, *Light Scattering by Small Particles* (Wiley, 1957), 7.22; C. F. Bohren and
//! D. R. Huffman, *Absorption and Scattering of Light by Small Particles* (Wiley, 1983), 6.1.

use std::f64::consts::PI;

use num_complex::Complex64;

use super::{
    CrossSections, FREE_SPACE, HostMedium, SPHERE, Scatterer, SphericalScatterer, positive,
    series::matrix,
};
use crate::{
    Defect, Jones,
    spec::{Class, Laws, Spec},
    special::gauss,
};

/// Name, parameters and constructor of a [`RayleighGansSphere`] sphere.
pub const SPEC: Spec<dyn Scatterer> = Spec {
    class: Class {
        name: "RayleighGansSphereScatterer",
        parent: "SphericalScatterer",
        summary: "Sphere of nearly the index of its medium",
        equation: "S1 = -2i (x/u)^3 (m-1)(sin(u) - u cos(u)), u = 2x sin(theta/2), S2 = S1 cos(theta)",
        source: "vandehulst-1957 bohren-huffman-1983",
        params: &[FREE_SPACE, SPHERE],
        laws: Laws::NONE,
    },
    build: |node| {
        let around = HostMedium::read(node)?;
        let radius = positive(node, "radius")?;
        let contrast = around.relative_index(node, "sphere")? - 1.0;
        let x = around.wave_number() * radius;
        let compat = node.reproduces(Defect::RayleighPhase);
        let phase = if compat { Complex64::I } else { -Complex64::I };
        let amplitude = 2.0 / 3.0 * x.powi(3) * phase * contrast;
        let cross_sections = cross_sections(radius, x, contrast);
        Ok(Box::new(RayleighGansSphere { around, x, amplitude, cross_sections }))
    },
};

/// A sphere of nearly the index of its medium.
#[derive(Clone, Copy, Debug)]
pub struct RayleighGansSphere {
    around: HostMedium,
    x: f64,
    /// S of forward light.
    amplitude: Complex64,
    cross_sections: CrossSections,
}

impl SphericalScatterer for RayleighGansSphere {
    fn surroundings(&self) -> &HostMedium {
        &self.around
    }

    fn amplitudes(&self, cos: f64) -> Jones {
        // sin(θ/2) = √((1 − cos θ)/2).
        let u = self.x * (2.0 * (1.0 - cos)).max(0.0).sqrt();
        let s1 = self.amplitude * form_factor(u);
        matrix((s1, s1 * cos))
    }

    fn cross_sections(&self) -> Option<CrossSections> {
        Some(self.cross_sections)
    }
}

/// 3(sin u − u cos u)/u³, 1 at 0.
fn form_factor(u: f64) -> f64 {
    if u < 0.1 {
        // The next term is u⁸/332640·… < 1e-14 of 1.
        let u2 = u * u;
        return 1.0 - u2 / 10.0 * (1.0 - u2 / 28.0 * (1.0 - u2 / 54.0));
    }
    3.0 * (u.sin() - u * u.cos()) / (u * u * u)
}

fn cross_sections(radius: f64, x: f64, contrast: Complex64) -> CrossSections {
    let area = PI * radius * radius;
    let strength = contrast.norm_sqr();
    let scattering = area * strength * total(x);
    CrossSections {
        scattering,
        extinction: area * 8.0 / 3.0 * x * contrast.im + scattering,
        back: area * strength * 16.0 / 9.0 * x.powi(4) * form_factor(2.0 * x).powi(2),
    }
}

/// C_sca/(πr²|m − 1|²).
fn total(x: f64) -> f64 {
    // The closed form cancels down to 32x⁴/27 for small x: there the integral over the angle.
    if x < 2.0 {
        let density = |cos: f64| {
            let f = form_factor(x * (2.0 * (1.0 - cos)).sqrt());
            4.0 / 9.0 * x.powi(4) * f * f * (1.0 + cos * cos)
        };
        return gauss::integrate(24, -1.0, 1.0, density);
    }
    let (y, x2) = (4.0 * x, x * x);
    2.5 + 2.0 * x2 - y.sin() / y - 7.0 * (1.0 - y.cos()) / (16.0 * x2)
        + (0.5 / x2 - 2.0) * entire_cosine_integral(y)
}

/// γ + ln y − Ci(y) = ∫₀^y (1 − cos t)/t dt.
fn entire_cosine_integral(y: f64) -> f64 {
    const EULER_GAMMA: f64 = 0.577_215_664_901_532_9;
    if y < 40.0 {
        // 48 nodes follow the seven periods of the integrand.
        return gauss::integrate(48, 0.0, y, |t| (1.0 - t.cos()) / t);
    }
    // Asymptotic series (Abramowitz & Stegun 5.2.34, 5.2.35); its terms fall until n ≈ y.
    let (mut f, mut g, mut term) = (0.0, 0.0, 1.0 / y);
    for n in 0..16 {
        let sign = if n % 4 < 2 { 1.0 } else { -1.0 };
        if n % 2 == 0 {
            f += sign * term;
        } else {
            g += sign * term;
        }
        term *= f64::from(n + 1) / y;
    }
    EULER_GAMMA + y.ln() - (f * y.sin() - g * y.cos())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Mode, ParameterNode, spec};

    #[test]
    fn forward_light_has_the_phase_of_mie_soundly_and_the_opposite_in_compat() {
        let forward = |mode| {
            let particle =
                spec::build::<dyn Scatterer>(&ParameterNode::with_defaults(&SPEC.class, mode))
                    .unwrap();
            particle.round().unwrap().amplitudes(1.0).pp
        };
        let (sound, compat) = (forward(Mode::Sound), forward(Mode::Compat));
        assert!(sound.im < 0.0 && (sound + compat).norm() < 1e-15 * sound.norm());
    }

    #[test]
    fn the_closed_form_and_the_integral_meet() {
        let density = |x: f64, c: f64| {
            let f = form_factor(x * (2.0 * (1.0 - c)).sqrt());
            4.0 / 9.0 * x.powi(4) * f * f * (1.0 + c * c)
        };
        for x in [1.9, 2.1, 5.0, 12.0] {
            let integral = gauss::integrate(80, -1.0, 1.0, |c| density(x, c));
            assert!((total(x) / integral - 1.0).abs() < 1e-12, "{x}: {} {integral}", total(x));
        }
    }

    #[test]
    fn both_forms_of_the_cosine_integral_meet() {
        let difference = entire_cosine_integral(40.0f64.next_down()) - entire_cosine_integral(40.0);
        // The asymptotic series ends at 16!/40^17.
        assert!(difference.abs() < 1e-12, "{difference}");
    }

    #[test]
    fn small_spheres_are_rayleigh_spheres() {
        // x → 0: 32x⁴/27.
        assert!((total(1e-3) / (32e-12 / 27.0) - 1.0).abs() < 1e-5);
        assert!((form_factor(0.1 - 1e-9) - form_factor(0.1 + 1e-9)).abs() < 1e-9);
    }
}
