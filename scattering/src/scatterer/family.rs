//! The family of particles in free space: its interface, and what its classes share.

use glam::DVec3;
use num_complex::Complex64;

use crate::{
    Jones,
    polarization::{TransverseFrame, perp},
    spec::{self, Family, Parameter, ParameterError, ParameterNode},
};

/// The family of particles in free space.
pub static FAMILY: Family =
    Family::new("Free_Space_Scatterer", "Free-space scatterers", spec::classes::<dyn Scatterer>)
        .with_abstract(&[("SphericalScatterer", "Free_Space_Scatterer")]);

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
    Parameter::number("lambda", 0.532, "um", "Vacuum wavelength"),
    Parameter::index("medium", (1.0, 0.0), "Index of the surrounding medium"),
];

/// The parameters of every sphere.
pub const SPHERE: &[Parameter] = &[
    Parameter::number("radius", 0.05, "um", "Outer radius"),
    Parameter::index("sphere", (1.59, 0.0), "Index of the sphere, or of its core"),
];
