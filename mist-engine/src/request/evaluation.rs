//! The evaluation of a material in single geometries.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::{material::Material, parameters};

/// A request for Mueller matrices in single geometries: a material, a basis, and the geometries.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EvaluationRequest {
    /// Name of the model's class.
    pub model: String,
    /// As in [`Material::parameters`].
    #[serde(default, with = "parameters")]
    pub parameters: Vec<(String, String)>,
    /// `psps`, `xyxy` or `plane`.
    #[serde(default = "psps")]
    pub basis: String,
    /// Geometries in which the model is evaluated.
    pub geometries: Vec<GeometryAngles>,
    /// As in [`Material::files`].
    #[serde(default)]
    pub files: BTreeMap<String, String>,
}

impl EvaluationRequest {
    /// Number of evaluations of the model.
    pub fn evaluations(&self) -> usize {
        self.geometries.len()
    }

    /// The material, and what remains: the basis and the geometries.
    pub fn into_parts(self) -> (Material, String, Vec<GeometryAngles>) {
        let Self { model, parameters, basis, geometries, files } = self;
        (Material { model, parameters, files }, basis, geometries)
    }
}

fn psps() -> String {
    "psps".into()
}

/// One geometry, radians.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GeometryAngles {
    /// Polar angle of incidence.
    pub theta_i: f64,
    /// Polar angle of scattering.
    pub theta_s: f64,
    /// Azimuth of scattering; 0 is the specular side.
    pub phi_s: f64,
    /// Rotation of the sample.
    #[serde(default)]
    pub rotation: f64,
}
