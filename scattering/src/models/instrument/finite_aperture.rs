//! Another model as a detector with a finite aperture sees it.
//!
//! $$ \mathbf{F} = \frac{1}{\cos\theta_s} \left\langle \mathbf{F}_{\mathrm{model}}(\theta_i;
//!    \theta, \varphi) \cos\theta \right\rangle $$
//!
//! is the mean over the cone of half-angle α around the viewing direction, by a Gauss rule on
//! the disk (`disk.rs`), of matrices in the xyxy basis. Directions below the horizon count as
//! dark.
//!
//! T. A. Germer and C. C. Asmail, *Goniometric optical scatter instrument for out-of-plane
//! ellipsometry measurements*, Rev. Sci. Instrum. 70, 3688 (1999).

use super::disk::{self, CONE, ConeAxis, DiskPoint};
use crate::{
    Basis, Direction, Incidence, Model, Mueller,
    models::{Brdf, COMMON, CommonParameters, FAMILY, LobeSupport, nested},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`FiniteAperture`].
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Finite_Aperture_Instrument_BRDF_Model",
        parent: "Instrument_BRDF_Model",
        summary: "Average of a model over the cone of the detector",
        equation: "F = <F_model cos> / cos_s over the cone",
        source: "germer-1999 stroud-1971",
        params: &[COMMON, INNER, CONE],
        laws: Laws { reciprocal: false, ..Laws::NOT_PASSIVE },
    },
    build: |node| {
        let common = CommonParameters::read(node)?;
        let model = Model::new(nested(node, "model", &common)?, node.mode);
        Ok(Box::new(FiniteAperture { common, model, points: disk::points(node)? }))
    },
};

/// The model that an instrument looks at.
pub(super) const INNER: &[Parameter] = &[Parameter::member(
    "model",
    &FAMILY,
    "Microroughness_BRDF_Model",
    "The model that the instrument looks at",
)];

/// A model seen through a finite aperture.
pub struct FiniteAperture {
    common: CommonParameters,
    model: Model,
    points: Vec<DiskPoint>,
}

impl FiniteAperture {
    fn average(
        &self,
        incidence: &Incidence,
        direction: &Direction,
        work: &mut ConeBuffers,
    ) -> Mueller {
        let beam =
            ConeAxis::new(direction.sin, direction.cos, direction.sin_phi, direction.cos_phi);
        for (node, point) in work.directions.iter_mut().zip(&self.points) {
            let (theta, phi) = disk::angles(point.tilt(&beam, 1.0));
            *node = Direction::new(theta, phi);
        }
        self.model.evaluate(incidence, &work.directions, Basis::Psps, &mut work.matrices);
        let sign = if self.common.side.to_below() { 1.0 } else { -1.0 };
        let mut sum = Mueller::ZERO;
        for ((node, point), m) in work.directions.iter().zip(&self.points).zip(&work.matrices) {
            sum += disk::turn_output(*m, sign * node.phi()) * (point.weight * node.cos);
        }
        sum * (1.0 / direction.cos)
    }

    fn work(&self) -> ConeBuffers {
        ConeBuffers {
            directions: vec![Direction::new(0.0, 0.0); self.points.len()],
            matrices: vec![Mueller::ZERO; self.points.len()],
        }
    }
}

/// The directions of the cone and what the model says there.
struct ConeBuffers {
    directions: Vec<Direction>,
    matrices: Vec<Mueller>,
}

impl Brdf for FiniteAperture {
    fn common(&self) -> &CommonParameters {
        &self.common
    }

    fn lobe_supports(&self, incidence: &Incidence) -> Vec<LobeSupport> {
        self.model.lobe_supports(incidence)
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        self.average(incidence, direction, &mut self.work())
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        let mut work = self.work();
        for (m, direction) in out.iter_mut().zip(directions) {
            *m = self.average(incidence, direction, &mut work);
        }
    }

    fn native_basis(&self) -> Basis {
        Basis::Xyxy
    }
}

#[cfg(test)]
mod tests {
    use crate::{Basis, Geometry, Mode, ParameterNode, models, spec::ParameterValue};

    #[test]
    fn without_an_aperture_it_is_the_model_in_every_basis() {
        let aperture =
            models::build(&ParameterNode::with_defaults(&super::SPEC.class, Mode::Sound));
        let inner = models::find("Microroughness_BRDF_Model").unwrap();
        let inner =
            models::build(&ParameterNode::with_defaults(&inner.class, Mode::Sound)).unwrap();
        let aperture = aperture.unwrap();
        let at = Geometry { theta_i: 0.7, theta_s: 0.5, phi_s: 2.0, rotation: 0.4 };
        for basis in [Basis::Psps, Basis::Xyxy, Basis::Plane] {
            let (a, b) = (aperture.mueller(&at, basis), inner.mueller(&at, basis));
            assert!((a - b).largest() < 1e-13 * b.largest(), "{basis:?}");
        }
    }

    #[test]
    fn a_white_wall_stays_as_bright_as_the_mean_cosine() {
        let lambertian = models::find("Lambertian_BRDF_Model").unwrap();
        let inner = ParameterNode::with_defaults(&lambertian.class, Mode::Sound);
        let node = ParameterNode::with_defaults(&super::SPEC.class, Mode::Sound)
            .with("model", ParameterValue::Member(inner.into()))
            .and_then(|n| n.with("alpha", ParameterValue::Number(5.0)))
            .and_then(|n| n.with("integralmode", ParameterValue::Integer(6)))
            .unwrap();
        let at = Geometry { theta_i: 0.7, theta_s: 0.5, phi_s: 2.0, rotation: 0.0 };
        let f = models::build(&node).unwrap().mueller(&at, Basis::Psps)[(0, 0)];
        // The mean of cos(αr) over the disk: 2(cos α + α sin α − 1)/α².
        let alpha = 5f64.to_radians();
        let mean = 2.0 * (alpha.cos() + alpha * alpha.sin() - 1.0) / (alpha * alpha);
        assert!((f * std::f64::consts::PI / mean - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_model_for_another_wavelength_is_refused() {
        let node = ParameterNode::with_defaults(&super::SPEC.class, Mode::Sound);
        let error = models::build(&node.with("lambda", ParameterValue::Number(0.6)).unwrap());
        assert_eq!(error.err().unwrap().parameter, "model.lambda");
    }
}
