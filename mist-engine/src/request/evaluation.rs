//! The evaluation of a material in single geometries.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::{
    material::{Material, MaterialDescription, ProgramDescription},
    parameters,
};

/// A request for Mueller matrices in single geometries: a material, a basis, and the geometries.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "EvaluationBody")]
pub struct EvaluationRequest {
    /// The material.
    pub material: MaterialDescription,
    /// `psps`, `xyxy` or `plane`.
    pub basis: String,
    /// Geometries in which the model is evaluated.
    pub geometries: Vec<GeometryAngles>,
}

/// The keys of an [`EvaluationRequest`] in JSON: those of the material beside the others.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct EvaluationBody {
    model: Option<String>,
    #[serde(default, with = "parameters")]
    parameters: Vec<(String, String)>,
    program: Option<String>,
    #[serde(default)]
    compat: bool,
    #[serde(default)]
    files: BTreeMap<String, String>,
    #[serde(default = "psps")]
    basis: String,
    geometries: Vec<GeometryAngles>,
}

impl TryFrom<EvaluationBody> for EvaluationRequest {
    type Error = &'static str;

    fn try_from(body: EvaluationBody) -> Result<Self, Self::Error> {
        let EvaluationBody { model, parameters, program, compat, files, basis, geometries } = body;
        let material = match (model, program) {
            (Some(model), None) if !compat => {
                MaterialDescription::Model(Material { model, parameters, files })
            }
            (None, Some(program)) if parameters.is_empty() => {
                let bare = ProgramDescription::bare(program);
                MaterialDescription::Program(ProgramDescription { compat, files, ..bare })
            }
            (None, None) => return Err("missing field `model` or `program`"),
            (Some(_), Some(_)) => return Err("`model` and `program` exclude each other"),
            (Some(_), None) => return Err("`compat` belongs to `program`, not to `model`"),
            (None, Some(_)) => return Err("`parameters` belong to `model`, not to `program`"),
        };
        Ok(Self { material, basis, geometries })
    }
}

impl EvaluationRequest {
    /// Number of evaluations of the model.
    pub fn evaluations(&self) -> usize {
        self.geometries.len()
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
