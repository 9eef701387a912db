//! Particles in free space.
//!
//! A particle that looks the same from every side is described by its amplitude matrix between
//! the directions ∥ and ⊥ to the scattering plane, [`SphericalScatterer`]; that gives it the matrix between
//! any two bases of [`Scatterer`]. Amplitudes are those of Bohren & Huffman: the scattered field
//! is S E e^{ikr}/(−ikr), so that |S|²/k² is the differential cross-section.

use crate::spec::{Member, Spec};

pub mod axisymmetric;
pub mod coated;
mod family;
pub mod layered;
pub mod mie;
pub mod multilayer;
pub mod optically_active;
pub mod rayleigh;
pub mod rayleigh_gans;
pub mod series;

pub use family::{
    CrossSections, FAMILY, FREE_SPACE, HostMedium, SPHERE, Scatterer, ScatteringPlaneRotation,
    SphericalScatterer, between, positive,
};

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Scatterer>] = &[
    &mie::SPEC,
    &coated::SPEC,
    &multilayer::SPEC,
    &rayleigh::SPEC,
    &rayleigh_gans::SPEC,
    &optically_active::SPEC,
    &axisymmetric::SPEC,
];

impl Member for dyn Scatterer {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[ALL];
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use glam::DVec3;

    use super::*;
    use crate::{
        Mode, ParameterNode, ParameterValue, optics::RefractiveIndex,
        polarization::TransverseFrame, spec, special::gauss,
    };

    const SPHERES: [&str; 5] = [
        "MieScatterer",
        "CoatedMieScatterer",
        "MultilayerCoatedMieScatterer",
        "RayleighScatterer",
        "RayleighGansSphereScatterer",
    ];

    fn build(name: &str, radius: f64, n: (f64, f64)) -> Box<dyn Scatterer> {
        let node =
            ParameterNode::with_defaults(crate::registry::find_class(name).unwrap(), Mode::Sound)
                .with("radius", ParameterValue::Number(radius))
                .and_then(|node| {
                    node.with("sphere", ParameterValue::Index(RefractiveIndex::constant(n.0, n.1)))
                })
                .unwrap();
        spec::build::<dyn Scatterer>(&node).unwrap()
    }

    #[test]
    fn the_scattering_cross_section_is_the_integral_of_the_differential_one() {
        for name in SPHERES {
            let particle = build(name, 0.12, (1.05, 0.003));
            let round = particle.round().unwrap();
            let k = round.surroundings().wave_number();
            let integral = gauss::integrate(60, -1.0, 1.0, |c| {
                let s = round.amplitudes(c);
                TAU * 0.5 * (s.ss.norm_sqr() + s.pp.norm_sqr()) / (k * k)
            });
            let expected = round.cross_sections().unwrap().scattering;
            assert!((integral / expected - 1.0).abs() < 1e-12, "{name}: {integral} {expected}");
        }
    }

    #[test]
    fn mie_spheres_obey_the_optical_theorem() {
        for (radius, n) in [(0.02, (1.59, 0.0)), (0.3, (1.4, 0.02)), (2.0, (0.3, 5.0))] {
            let particle = build("MieScatterer", radius, n);
            let round = particle.round().unwrap();
            let k = round.surroundings().wave_number();
            let forward = 2.0 * TAU / (k * k) * round.amplitudes(1.0).pp.re;
            let expected = round.cross_sections().unwrap().extinction;
            assert!((forward / expected - 1.0).abs() < 1e-12, "{radius}");
        }
    }

    #[test]
    fn small_and_faint_spheres_agree_with_mie_in_phase_too() {
        // The next order is x² = 2e-4 of the leading one, and |m − 1| = 1e-4 for Rayleigh–Gans.
        let cases =
            [("RayleighScatterer", 1e-3, 1.5), ("RayleighGansSphereScatterer", 0.05, 1.0001)];
        for (name, radius, n) in cases {
            let (mie, other) =
                (build("MieScatterer", radius, (n, 0.0)), build(name, radius, (n, 0.0)));
            for cos in [-1.0, -0.3, 0.6, 1.0] {
                let a = mie.round().unwrap().amplitudes(cos);
                let b = other.round().unwrap().amplitudes(cos);
                assert!((a.pp - b.pp).norm() < 5e-4 * a.pp.norm(), "{name} {} {}", a.pp, b.pp);
                assert!((a.ss - b.ss).norm() < 5e-4 * a.pp.norm(), "{name} {} {}", a.ss, b.ss);
            }
        }
    }

    #[test]
    fn the_amplitudes_of_forward_and_backward_light_need_no_plane() {
        let particle = build("MieScatterer", 0.3, (1.5, 0.01));
        let k = DVec3::new(0.6, 0.0, -0.8);
        let frame = TransverseFrame::psps(k);
        let forward = particle.jones(k, k, &frame, &frame);
        assert!((forward.ss - forward.pp).norm() < 1e-14 && forward.ps.norm() < 1e-14);
        let back = particle.jones(k, -k, &frame, &TransverseFrame::psps(-k));
        assert!(back.ps.norm() < 1e-14 && back.ss.norm() > 0.0);
    }

    #[test]
    fn bad_parameters_are_refused() {
        for name in SPHERES {
            for (parameter, value) in [("radius", 0.0), ("radius", f64::NAN), ("lambda", -1.0)] {
                let node = ParameterNode::with_defaults(
                    crate::registry::find_class(name).unwrap(),
                    Mode::Sound,
                )
                .with(parameter, ParameterValue::Number(value))
                .unwrap();
                let error = spec::build::<dyn Scatterer>(&node).err().unwrap();
                assert_eq!(error.parameter, parameter, "{name}");
            }
        }
    }
}
