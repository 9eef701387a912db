//! Particles in free space.
//!
//! A particle that looks the same from every side is described by its amplitude matrix between
//! the directions ∥ and ⊥ to the scattering plane, [`SphericalScatterer`]; that gives it the matrix between
//! any two bases of [`Scatterer`]. Amplitudes are those of Bohren & Huffman: the scattered field
//! is S E e^{ikr}/(−ikr), so that |S|²/k² is the differential cross-section.

use glam::DVec3;
use num_complex::Complex64;

use crate::{
    Jones,
    polarization::{TransverseFrame, perp},
    spec::{Family, Member, Parameter, ParameterError, ParameterNode, Spec},
};

pub mod axisymmetric;
pub mod coated;
pub mod layered;
pub mod mie;
pub mod multilayer;
pub mod optically_active;
pub mod rayleigh;
pub mod rayleigh_gans;
pub mod series;

/// A particle in a homogeneous medium.
pub trait Scatterer: Send + Sync {
    /// Vacuum wavelength it was prepared for, µm.
    fn lambda(&self) -> f64;

    /// Index of the surrounding medium at that wavelength.
    fn medium(&self) -> Complex64;

    /// Scattering matrix between the beams `k_in` and `k_out` (unit vectors in the frame of the
    /// particle), dimensionless: |S|²/k² is the differential cross-section. Output and input are
    /// in the frames (s, p) = (`TransverseFrame::first`, `TransverseFrame::second`) given.
    fn jones(
        &self,
        k_in: DVec3,
        k_out: DVec3,
        frame_in: &TransverseFrame,
        frame_out: &TransverseFrame,
    ) -> Jones;

    /// The particle as one that looks the same from every side, if it does.
    fn round(&self) -> Option<&dyn SphericalScatterer> {
        None
    }
}

/// A particle that looks the same from every side: only the scattering angle counts.
pub trait SphericalScatterer: Send + Sync {
    /// Position.
    fn surroundings(&self) -> &HostMedium;

    /// Amplitude matrix at the cosine of the scattering angle, ∥ in place of s and ⊥ in that
    /// of p: `ss` = S2, `pp` = S1, `ps` = S3, `sp` = S4.
    fn amplitudes(&self, cos: f64) -> Jones;

    /// Its cross-sections, for spheres of an isotropic material.
    fn cross_sections(&self) -> Option<CrossSections> {
        None
    }
}

/// Cross-sections in µm².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossSections {
    /// Total scattering.
    pub scattering: f64,
    /// Extinction.
    pub extinction: f64,
    /// 4π times the differential cross-section of exact back-scattering.
    pub back: f64,
}

impl<T: SphericalScatterer> Scatterer for T {
    fn lambda(&self) -> f64 {
        self.surroundings().lambda
    }

    fn medium(&self) -> Complex64 {
        self.surroundings().medium
    }

    fn jones(
        &self,
        k_in: DVec3,
        k_out: DVec3,
        frame_in: &TransverseFrame,
        frame_out: &TransverseFrame,
    ) -> Jones {
        let cos = k_in.dot(k_out).clamp(-1.0, 1.0);
        between(&self.amplitudes(cos), k_in, k_out, frame_in, frame_out)
    }

    fn round(&self) -> Option<&dyn SphericalScatterer> {
        Some(self)
    }
}

/// The amplitude matrix `amplitudes` of the scattering plane, in the frames given.
pub fn between(
    amplitudes: &Jones,
    k_in: DVec3,
    k_out: DVec3,
    frame_in: &TransverseFrame,
    frame_out: &TransverseFrame,
) -> Jones {
    ScatteringPlaneRotation::new(k_in, k_out, frame_in, frame_out).apply(amplitudes)
}

/// The changes of basis into the scattering plane of two beams and out of it.
#[derive(Clone, Copy, Debug)]
pub struct ScatteringPlaneRotation {
    into: Jones,
    out: Jones,
}

impl ScatteringPlaneRotation {
    /// Between the beams `k_in` and `k_out` in the frames given.
    pub fn new(
        k_in: DVec3,
        k_out: DVec3,
        frame_in: &TransverseFrame,
        frame_out: &TransverseFrame,
    ) -> Self {
        let across = perp(k_in, k_out);
        let plane_in = TransverseFrame { first: across.cross(k_in), second: across };
        let plane_out = TransverseFrame { first: across.cross(k_out), second: across };
        Self { into: frame_in.to(&plane_in), out: plane_out.to(frame_out) }
    }

    /// A matrix given in (∥, ⊥) in the frames of the beams.
    pub fn apply(&self, amplitudes: &Jones) -> Jones {
        self.out * *amplitudes * self.into
    }
}

/// The medium around a particle at one wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HostMedium {
    /// Vacuum wavelength, µm.
    pub lambda: f64,
    /// Index of the medium.
    pub medium: Complex64,
}

impl HostMedium {
    /// Reads the parameters [`FREE_SPACE`] of `node`.
    ///
    /// # Errors
    ///
    /// For a wavelength or an index that is not positive.
    pub fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let lambda = positive(node, "lambda")?;
        let medium = node.index("medium").at(lambda);
        if !(medium.re > 0.0 && medium.re.is_finite()) {
            return Err(ParameterError::new(
                "medium",
                format!("{medium} is not the index of a medium"),
            ));
        }
        Ok(Self { lambda, medium })
    }

    /// Wave number in the medium, 1/µm, as if it did not absorb.
    pub fn wave_number(&self) -> f64 {
        std::f64::consts::TAU * self.medium.re / self.lambda
    }

    /// The index `name` of `node` relative to the medium.
    ///
    /// # Errors
    ///
    /// For the index 0.
    pub fn relative_index(
        &self,
        node: &ParameterNode,
        name: &str,
    ) -> Result<Complex64, ParameterError> {
        self.relative(node.index(name).at(self.lambda), name)
    }

    /// The index `n` of the parameter `name` relative to the medium.
    ///
    /// # Errors
    ///
    /// For the index 0.
    pub fn relative(&self, n: Complex64, name: &str) -> Result<Complex64, ParameterError> {
        if n.norm() > 0.0 && n.is_finite() {
            return Ok(n / self.medium.re);
        }
        Err(ParameterError::new(name, format!("{n} is not an index of refraction")))
    }

    /// The radius (µm) of a sphere whose parts have the indices `relative` to the medium.
    ///
    /// # Errors
    ///
    /// If it is not positive, or if the sphere is too large for a series.
    pub fn radius(
        &self,
        node: &ParameterNode,
        relative: &[Complex64],
    ) -> Result<f64, ParameterError> {
        let radius = positive(node, "radius")?;
        let largest = relative.iter().map(|m| m.norm()).fold(1.0, f64::max);
        let size = self.wave_number() * radius * largest;
        if size <= LARGEST_SPHERE {
            return Ok(radius);
        }
        let problem = format!(
            "a sphere of {radius} um has the size 2 pi n r/lambda = {size:.3e}; \
             the series goes up to {LARGEST_SPHERE:e}"
        );
        Err(ParameterError::new("radius", problem))
    }
}

/// The largest 2π|n|r/λ of a sphere; as many terms take a second.
const LARGEST_SPHERE: f64 = 1e7;

/// The number `name`, which has to be positive and finite.
///
/// # Errors
///
/// If it is not.
pub fn positive(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let x = node.number(name);
    if x > 0.0 && x.is_finite() {
        return Ok(x);
    }
    Err(ParameterError::new(name, format!("{x} um is not positive")))
}

/// The parameters of every particle in free space.
pub const FREE_SPACE: &[Parameter] = &[
    Parameter::number("lambda", "0.532", "um", "Vacuum wavelength"),
    Parameter::index("medium", "(1,0)", "Index of the surrounding medium"),
];

/// The parameters of every sphere.
pub const SPHERE: &[Parameter] = &[
    Parameter::number("radius", "0.05", "um", "Outer radius"),
    Parameter::index("sphere", "(1.59,0)", "Index of the sphere, or of its core"),
];

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
    const FAMILY: Family = Family::Scatterer;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(ALL.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::{Mode, ParameterValue, optics::RefractiveIndex, spec, special::gauss};

    const SPHERES: [&str; 5] = [
        "MieScatterer",
        "CoatedMieScatterer",
        "MultilayerCoatedMieScatterer",
        "RayleighScatterer",
        "RayleighGansSphereScatterer",
    ];

    fn build(name: &str, radius: f64, n: (f64, f64)) -> Box<dyn Scatterer> {
        let node = ParameterNode::with_defaults(spec::find_class(name).unwrap(), Mode::Sound)
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
                let node =
                    ParameterNode::with_defaults(spec::find_class(name).unwrap(), Mode::Sound)
                        .with(parameter, ParameterValue::Number(value))
                        .unwrap();
                let error = spec::build::<dyn Scatterer>(&node).err().unwrap();
                assert_eq!(error.parameter, parameter, "{name}");
            }
        }
    }
}
