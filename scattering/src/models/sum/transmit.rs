//! Another model behind a second, smooth face of the substrate.
//!
//! Angles on the side of the substrate are those outside the second face. With sin θ' = sin θ / n and
//! T(θ) the Mueller matrix of the transmission coefficients of `films` from outside into the
//! substrate,
//!
//! $$ \tau(\theta) = \frac{n \cos\theta'}{\cos\theta}\,\mathbf{T}(\theta) $$
//!
//! type 0: the inner model; 1: $\tau(\theta_s)\,\mathbf{F}(\theta_i, \theta_s')/n^2$; 2:
//! $\tau(\theta_s)\,\mathbf{F}(\theta_i', \theta_s')\,\tau(\theta_i)/n^2$; 3:
//! $\mathbf{F}(\theta_i', \theta_s)\,\tau(\theta_i)$. τ has the same value for light that leaves;
//! 1/n² is the ratio of solid angles. Light that the second face reflects is lost.
//!
//! M. Born and E. Wolf, *Principles of Optics*, 7th ed. (1999), sections 1.5 and 4.8.

use std::slice;

use num_complex::Complex64;

use crate::{
    Basis, Direction, Incidence, Model, Mueller,
    models::{Brdf, COMMON, CommonParameters, FAMILY, LobeSupport, nested},
    optics::film::Films,
    spec::{Class, Laws, Parameter, Spec},
    stack::{self, Stack},
};

/// Name, parameters and constructor of a [`Transmit`].
pub const SPEC: Spec<dyn Brdf> = Spec {
    class: Class {
        name: "Transmit_BRDF_Model",
        parent: "BRDF_Model",
        summary: "A model behind a second, smooth face of the substrate",
        equation: "F = tau(theta_s) F_model tau(theta_i), tau = n cos'/cos M(t), 1/n^2 on the way out",
        source: "born-1999",
        params: &[
            COMMON,
            &[
                Parameter::member(
                    "model",
                    &FAMILY,
                    "Microroughness_BRDF_Model",
                    "The model behind the face",
                ),
                Parameter::member(
                    "films",
                    &stack::FAMILY,
                    "No_StackModel",
                    "Films on the second face",
                ),
            ],
        ],
        laws: Laws::NOT_PASSIVE,
    },
    build: |node| {
        let common = CommonParameters::read(node)?;
        let model = Model::new(nested(node, "model", &common)?, node.mode);
        let films = node.member::<Stack>("films")?.at(common.lambda);
        let films = Films::new(&films, Complex64::ONE, common.substrate, common.lambda);
        Ok(Box::new(Transmit { common, model, films, index: common.substrate.re }))
    },
};

/// A model behind a smooth face.
pub struct Transmit {
    common: CommonParameters,
    model: Model,
    films: Films,
    /// n.
    index: f64,
}

impl Transmit {
    /// θ' and τ(θ) for light that meets the face at an angle with this sine and cosine outside.
    fn cross(&self, sin: f64, cos: f64) -> (f64, Mueller) {
        let inside = (sin / self.index).asin();
        let factor = self.index * inside.cos() / cos;
        (inside, self.films.t12(sin.into()).jones().mueller() * factor)
    }

    /// The directions inside for those outside, with the matrices of the face.
    fn behind(&self, directions: &[Direction]) -> (Vec<Direction>, Vec<Mueller>) {
        directions
            .iter()
            .map(|d| {
                let (theta, tau) = self.cross(d.sin, d.cos);
                (Direction::new(theta, d.phi()), tau)
            })
            .unzip()
    }
}

impl Transmit {
    /// The beam inside, for light that comes through the face, and the matrix of the face.
    fn beam_inside(&self, incidence: &Incidence) -> (Incidence, Option<Mueller>) {
        if !self.common.side.from_below() {
            return (*incidence, None);
        }
        let (theta, tau) = self.cross(incidence.sin, incidence.cos);
        (Incidence::new(theta, incidence.rotation()), Some(tau))
    }
}

impl Brdf for Transmit {
    fn common(&self) -> &CommonParameters {
        &self.common
    }

    fn lobe_supports(&self, incidence: &Incidence) -> Vec<LobeSupport> {
        let supports = self.model.lobe_supports(&self.beam_inside(incidence).0);
        if !self.common.side.to_below() {
            return supports;
        }
        supports.into_iter().filter_map(|support| support.refracted(self.index)).collect()
    }

    fn mueller(&self, incidence: &Incidence, direction: &Direction) -> Mueller {
        let mut out = [Mueller::ZERO];
        self.mueller_batch(incidence, slice::from_ref(direction), &mut out);
        out[0]
    }

    fn mueller_batch(&self, incidence: &Incidence, directions: &[Direction], out: &mut [Mueller]) {
        let (inner, into) = self.beam_inside(incidence);
        if self.common.side.to_below() {
            let (directions, faces) = self.behind(directions);
            self.model.evaluate(&inner, &directions, Basis::Psps, out);
            let spread = 1.0 / (self.index * self.index);
            for (m, tau) in out.iter_mut().zip(faces) {
                *m = tau * *m * spread;
            }
        } else {
            self.model.evaluate(&inner, directions, Basis::Psps, out);
        }
        if let Some(tau) = into {
            for m in out {
                *m = *m * tau;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{
        Basis, Geometry, Mode, ParameterNode, models, optics::RefractiveIndex, spec::ParameterValue,
    };

    #[test]
    fn without_contrast_the_face_is_invisible() {
        let at = Geometry { theta_i: 0.4, theta_s: 0.9, phi_s: 1.0, rotation: 0.0 };
        for side in [0, 1, 2, 3] {
            let vacuum = |name: &str| {
                ParameterNode::with_defaults(&models::find(name).unwrap().class, Mode::Sound)
                    .with("substrate", ParameterValue::Index(RefractiveIndex::constant(1.0, 0.0)))
                    .and_then(|node| node.with("type", ParameterValue::Integer(side)))
                    .unwrap()
            };
            let inner = vacuum("Lambertian_BRDF_Model");
            let bare = models::build(&inner).unwrap().mueller(&at, Basis::Psps);
            let node = vacuum(super::SPEC.class.name)
                .with("model", ParameterValue::Member(inner.into()))
                .unwrap();
            let behind = models::build(&node).unwrap().mueller(&at, Basis::Psps);
            assert!((bare - behind).largest() < 1e-15, "type {side}");
        }
    }
}
