//! Another model in a converging beam.
//!
//! $$ \mathbf{F} = \frac{\langle \mathbf{F}_{\mathrm{model}}(\theta, \ldots) \cos\theta\,
//!    \cos\theta' \rangle}{\cos\theta_i \cos\theta_s} $$
//!
//! is the mean over the cone of half-angle α around the source, by a Gauss rule on the disk
//! (`disk.rs`), of matrices in the xyxy basis. Every ray meets the viewer along a direction
//! tilted by `focal_point` times its own tilt: 0 for a beam focussed on the sample, 1 for one
//! focussed on the detector. Rays and views below the horizon count as dark.
//!
//! NIST's library mirrors the azimuth of every ray before it evaluates the model, so that the elements
//! that mix I and Q with U and V have the opposite sign of those of a parallel beam
//! ([`Defect::FocussedMirror`]); a ray along the normal is NaN in it.
//!
//! T. A. Germer and C. C. Asmail, *Goniometric optical scatter instrument for out-of-plane
//! ellipsometry measurements*, Rev. Sci. Instrum. 70, 3688 (1999).

use std::f64::consts::PI;

use super::{
    disk::{self, CONE, ConeAxis, DiskPoint},
    finite_aperture::INNER,
};
use crate::{
    Basis, Defect, Direction, Incidence, Model, Mueller, ParameterError,
    models::{Brdf, COMMON, CommonParameters, LobeSupport, nested},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`FocussedBeam`].
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Focussed_Beam_Instrument_BRDF_Model",
        parent: "Instrument_BRDF_Model",
        summary: "Average of a model over a converging beam",
        equation: "F = <F_model cos cos'> / (cos_i cos_s) over the cone",
        source: "germer-1999 stroud-1971",
        params: &[COMMON, INNER, CONE, OWN],
        laws: Laws { reciprocal: false, ..Laws::NOT_PASSIVE },
    },
    build: |node| {
        let common = CommonParameters::read(node)?;
        let model = Model::new(nested(node, "model", &common)?, node.mode);
        let focal_point = node.number("focal_point");
        if !focal_point.is_finite() {
            return Err(ParameterError::new("focal_point", format!("{focal_point} is not finite")));
        }
        let points = disk::points(node)?;
        let mirrored = node.number("alpha") != 0.0 && node.reproduces(Defect::FocussedMirror);
        Ok(Box::new(FocussedBeam { common, model, points, focal_point, mirrored }))
    },
};

const OWN: &[Parameter] = &[Parameter::number(
    "focal_point",
    1.0,
    "1",
    "Where the beam is focussed: 0 on the sample, 1 on the detector",
)];

/// A model in a converging beam.
pub struct FocussedBeam {
    common: CommonParameters,
    model: Model,
    points: Vec<DiskPoint>,
    focal_point: f64,
    mirrored: bool,
}

/// One ray of the beam.
struct ConeRay<'a> {
    incidence: Incidence,
    /// Azimuth of its propagation in the laboratory.
    azimuth: f64,
    point: &'a DiskPoint,
}

impl FocussedBeam {
    fn ray<'a>(&self, source: &ConeAxis, rotation: f64, point: &'a DiskPoint) -> ConeRay<'a> {
        let (theta, phi) = disk::angles(point.tilt(source, 1.0));
        // The source stands opposite to the propagation; along the normal any azimuth will do.
        let azimuth = if theta == 0.0 { 0.0 } else { phi - PI };
        ConeRay { incidence: Incidence::new(theta, rotation - azimuth), azimuth, point }
    }

    fn add(&self, ray: &ConeRay<'_>, viewer: &ConeAxis, cosines: f64, out: &mut Mueller) {
        let (theta, phi) = disk::angles(ray.point.tilt(viewer, self.focal_point));
        let azimuth = phi - ray.azimuth;
        let azimuth = if self.mirrored { -azimuth } else { azimuth };
        let direction = Direction::new(theta, azimuth);
        let mut m = [Mueller::ZERO];
        if self.mirrored && ray.incidence.sin == 0.0 {
            *out += Mueller([[f64::NAN; 4]; 4]);
            return;
        }
        self.model.evaluate(&ray.incidence, &[direction], Basis::Psps, &mut m);
        let side = self.common.side;
        // From psps to xyxy of the ray's own plane of incidence, then to that of the laboratory.
        let outwards = azimuth + ray.azimuth;
        let outwards = if side.to_below() { outwards } else { -outwards };
        let inwards = if side.from_below() { -ray.azimuth } else { ray.azimuth };
        let turned = disk::turn_input(disk::turn_output(m[0], outwards), inwards);
        *out += turned * (ray.point.weight * ray.incidence.cos * direction.cos / cosines);
    }
}

impl Brdf for FocussedBeam {
    fn common(&self) -> &CommonParameters {
        &self.common
    }

    fn lobe_supports(&self, incidence: &Incidence) -> Vec<LobeSupport> {
        self.model.lobe_supports(incidence)
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        let mut out = [Mueller::ZERO];
        self.mueller_batch(incidence, std::slice::from_ref(direction), &mut out);
        out[0]
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        out.fill(Mueller::ZERO);
        let source = ConeAxis::new(incidence.sin, incidence.cos, 0.0, -1.0);
        for point in &self.points {
            let ray = self.ray(&source, incidence.rotation(), point);
            for (m, d) in out.iter_mut().zip(directions) {
                let viewer = ConeAxis::new(d.sin, d.cos, d.sin_phi, d.cos_phi);
                self.add(&ray, &viewer, incidence.cos * d.cos, m);
            }
        }
    }

    fn native_basis(&self) -> Basis {
        Basis::Xyxy
    }
}

#[cfg(test)]
mod tests {
    use crate::{Basis, Geometry, Mode, Mueller, ParameterNode, models, spec::ParameterValue};

    #[test]
    fn a_parallel_beam_gives_the_model_in_every_basis() {
        let beam =
            models::build(&ParameterNode::with_defaults(&super::SPEC.class, Mode::Sound)).unwrap();
        let inner = models::find("Microroughness_BRDF_Model").unwrap();
        let inner =
            models::build(&ParameterNode::with_defaults(&inner.class, Mode::Sound)).unwrap();
        let at = Geometry { theta_i: 0.7, theta_s: 0.5, phi_s: 2.0, rotation: 0.4 };
        for basis in [Basis::Psps, Basis::Xyxy, Basis::Plane] {
            let (a, b) = (beam.mueller(&at, basis), inner.mueller(&at, basis));
            assert!((a - b).largest() < 1e-13 * b.largest(), "{basis:?}");
        }
    }

    #[test]
    fn compat_mirrors_the_model_and_sound_does_not() {
        let build = |mode| {
            let node = ParameterNode::with_defaults(&super::SPEC.class, mode);
            models::build(&node.with("alpha", ParameterValue::Number(1e-6)).unwrap()).unwrap()
        };
        let at = Geometry { theta_i: 0.7, theta_s: 0.5, phi_s: 2.0, rotation: 0.0 };
        let (sound, compat) = (build(Mode::Sound), build(Mode::Compat));
        let (a, b) = (sound.mueller(&at, Basis::Xyxy), compat.mueller(&at, Basis::Xyxy));
        let q = Mueller::diagonal([1.0, 1.0, -1.0, -1.0]);
        assert!((q * a * q - b).largest() < 1e-6 * a.largest());
        assert!((a - b).largest() > 0.1 * a.largest());
    }

    #[test]
    fn a_ray_along_the_normal_is_nan_in_compat_only() {
        let at = Geometry { theta_i: 0.0, theta_s: 0.5, phi_s: 2.0, rotation: 0.0 };
        for (mode, is_finite) in [(Mode::Sound, true), (Mode::Compat, false)] {
            // The third rule has a point in the middle of the cone.
            let node = ParameterNode::with_defaults(&super::SPEC.class, mode);
            let node = node.with("alpha", ParameterValue::Number(1.0)).unwrap();
            let m = models::build(&node).unwrap().mueller(&at, Basis::Psps);
            assert_eq!(m.0.iter().flatten().all(|x| x.is_finite()), is_finite, "{mode:?}");
        }
    }

    #[test]
    fn a_narrow_cone_hardly_changes_a_smooth_model() {
        let node = ParameterNode::with_defaults(&super::SPEC.class, Mode::Sound)
            .with("alpha", ParameterValue::Number(0.01))
            .unwrap();
        let parallel =
            models::build(&ParameterNode::with_defaults(&super::SPEC.class, Mode::Sound)).unwrap();
        let narrow = models::build(&node).unwrap();
        // Also at normal incidence, where the azimuths of the rays go all around.
        for theta_i in [0.0, 0.7] {
            let at = Geometry { theta_i, theta_s: 0.5, phi_s: 2.0, rotation: 0.4 };
            let (a, b) = (narrow.mueller(&at, Basis::Xyxy), parallel.mueller(&at, Basis::Xyxy));
            // Second order in the half-angle of 1.7e-4 rad, times the curvature of the spectrum.
            assert!((a - b).largest() < 1e-5 * b.largest(), "{theta_i}");
        }
    }
}
