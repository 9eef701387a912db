//! Phase matrix of a suspension of equal spheres.
//!
//! $$ P = \frac{M(\mathrm{diag}(S_2, S_1))}{k^2 C_{sca}} \qquad (1) $$
//!
//! $$ \kappa_s = N C_{sca}, \quad \kappa_a = N (C_{ext} - C_{sca}) \qquad (2) $$
//!
//! k is the wave number in the medium, N (`volume_density`) the number of spheres per volume.
//! `--compat` takes k in vacuum, C_sca from 1000 rectangles and κ_a from the forward amplitude.
//!
//! C. F. Bohren and D. R. Huffman, *Absorption and Scattering of Light by Small Particles*
//! (Wiley, 1983), 3.3 and 3.4.

use std::f64::consts::{PI, TAU};

use super::PolarizedPhase;
use crate::{
    Defect, Jones, Mueller,
    scatterer::{self, CrossSections, Scatterer, SphericalScatterer},
    spec::{Class, Laws, Parameter, ParameterError, Spec},
};

/// Name, parameters and constructor of a suspension of equal [`Spheres`].
pub const SPEC: Spec<dyn PolarizedPhase> = Spec {
    class: Class {
        name: "SphericalScatterer_Phase_Function",
        parent: "Polarized_Phase_Function",
        summary: "Suspension of equal spheres",
        equation: "P = M(diag(S2,S1))/(k^2 Csca), kappa_s = N Csca, kappa_a = N (Cext-Csca)",
        source: "bohren-huffman-1983",
        params: &[&[
            Parameter::member_below(
                "scatterer",
                &scatterer::FAMILY,
                "SphericalScatterer",
                "MieScatterer",
                "The sphere; its lambda and medium are its own",
            ),
            Parameter::number("volume_density", 1e-4, "1/um^3", "Number of spheres per volume"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let particle = node.member::<dyn Scatterer>("scatterer")?;
        let Some(cross) = particle.round().and_then(SphericalScatterer::cross_sections) else {
            return Err(ParameterError::new("scatterer", "not a sphere of an isotropic material"));
        };
        let density = node.number("volume_density");
        if !(density > 0.0 && density.is_finite()) {
            return Err(ParameterError::new(
                "volume_density",
                format!("{density} is not positive"),
            ));
        }
        let compat = node.reproduces(Defect::SpherePhaseMedium);
        Ok(Box::new(Spheres::new(particle, cross, density, compat)))
    },
};

/// A suspension of equal spheres.
struct Spheres {
    particle: Box<dyn Scatterer>,
    /// 1/(k² C_sca).
    norm: f64,
    /// κ_a, 1/µm.
    absorption: f64,
    /// κ_s, 1/µm.
    scattering: f64,
}

impl Spheres {
    fn new(particle: Box<dyn Scatterer>, cross: CrossSections, density: f64, compat: bool) -> Self {
        let k0 = TAU / particle.lambda();
        let (k, cross, least) = if compat {
            (k0, compat_cross_sections(&*particle, k0), f64::NEG_INFINITY)
        } else {
            // Lossless spheres absorb a rounding error.
            (k0 * particle.medium().re, cross, 0.0)
        };
        // (2)
        Self {
            norm: 1.0 / (k * k * cross.scattering),
            absorption: (density * (cross.extinction - cross.scattering)).max(least),
            scattering: density * cross.scattering,
            particle,
        }
    }
}

fn amplitudes(particle: &dyn Scatterer, cos: f64) -> Jones {
    particle.round().expect("checked when it was built").amplitudes(cos)
}

/// Scattering by a rectangle sum, extinction by the forward amplitude, both with the wave number
/// `k` of vacuum.
fn compat_cross_sections(particle: &dyn Scatterer, k: f64) -> CrossSections {
    const STEPS: usize = 1000;
    let step = PI / STEPS as f64;
    let sum: f64 = (0..=STEPS)
        .map(|j| {
            let t = j as f64 * step;
            let s = amplitudes(particle, t.cos());
            0.5 * (s.ss.norm_sqr() + s.pp.norm_sqr()) * t.sin()
        })
        .sum();
    CrossSections {
        scattering: TAU * step * sum / (k * k),
        extinction: 2.0 * TAU / (k * k) * amplitudes(particle, 1.0).pp.re,
        back: 0.0,
    }
}

impl PolarizedPhase for Spheres {
    fn at_cosine(&self, cos: f64) -> Mueller {
        // (1)
        amplitudes(&*self.particle, cos).mueller() * self.norm
    }

    fn absorption(&self) -> f64 {
        self.absorption
    }

    fn scattering(&self) -> f64 {
        self.scattering
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::{Mode, ParameterNode, ParameterValue, optics::RefractiveIndex, spec};

    fn build(mode: Mode, scatterer: &str) -> Box<dyn PolarizedPhase> {
        let index = |n, k| ParameterValue::Index(RefractiveIndex::constant(n, k));
        let inner =
            ParameterNode::with_defaults(crate::registry::find_class(scatterer).unwrap(), mode)
                .with("medium", index(1.5, 0.0))
                .and_then(|node| node.with("sphere", index(1.6, 0.01)))
                .unwrap();
        let node = ParameterNode::with_defaults(&SPEC.class, mode)
            .with("scatterer", ParameterValue::Member(Arc::new(inner)))
            .unwrap();
        spec::build::<dyn PolarizedPhase>(&node).unwrap()
    }

    #[test]
    fn coefficients_are_too_large_by_the_square_of_the_index_in_compat() {
        let (sound, compat) =
            (build(Mode::Sound, "MieScatterer"), build(Mode::Compat, "MieScatterer"));
        // The rectangle sum over a smooth sin t is good to a few 1e-6.
        assert!((compat.scattering() / sound.scattering() / 2.25 - 1.0).abs() < 1e-5);
        assert!((compat.absorption() / sound.absorption() / 2.25 - 1.0).abs() < 1e-5);
    }

    #[test]
    fn rayleigh_spheres_absorb_soundly_as_much_as_mie_spheres() {
        let mie = build(Mode::Sound, "MieScatterer").absorption();
        let rayleigh = build(Mode::Sound, "RayleighScatterer").absorption();
        // x = 0.9: the small-sphere limit is a rough one.
        assert!((rayleigh / mie - 1.0).abs() < 0.1, "{rayleigh} {mie}");
        let compat = build(Mode::Compat, "RayleighScatterer").absorption();
        assert!((compat / mie / 2.25 - 1.0).abs() > 1.0, "{compat}");
    }

    #[test]
    fn chiral_spheres_are_refused() {
        let class = crate::registry::find_class("Optically_Active_Sphere_Scatterer").unwrap();
        let inner = ParameterNode::with_defaults(class, Mode::Sound);
        let node = ParameterNode::with_defaults(&SPEC.class, Mode::Sound)
            .with("scatterer", ParameterValue::Member(Arc::new(inner)))
            .unwrap();
        assert_eq!((SPEC.build)(&node).err().unwrap().parameter, "scatterer");
    }
}
