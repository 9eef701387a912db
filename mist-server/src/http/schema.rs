//! The JSON of requests and answers that other crates define, as the API describes it.
//!
//! Types that are marked so are not read: they only describe the API in `/openapi.json`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use utoipa::{IntoParams, ToSchema};

/// The name of a material.
#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[expect(dead_code, reason = "describes the API")]
pub(super) struct MaterialName {
    /// The name of the material.
    name: String,
}

/// The content of a material.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Hash)]
pub(super) struct MaterialHash {
    /// `sha256-…` of the body that brought it.
    pub(super) hash: String,
}

/// A material in the list.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Listed)]
pub(super) struct MaterialEntry {
    /// Its name.
    pub(super) name: String,
    /// `sha256-…` of the body that brought it.
    pub(super) hash: String,
}

/// A material: a model with parameters, or a program whose first step counts.
#[derive(Deserialize, ToSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "describes the API")]
pub(super) enum MaterialBody {
    /// A model with the parameters that differ from its defaults.
    Model(ModelBody),
    /// A program with its data files.
    Program(ProgramBody),
}

/// A program with its data files; it sees no others.
#[derive(Deserialize, ToSchema)]
#[expect(dead_code, reason = "describes the API")]
pub(super) struct ProgramBody {
    /// The text of the program.
    program: String,
    /// Texts of data files by the names that the program gives them.
    #[serde(default)]
    files: BTreeMap<String, String>,
    /// Give NIST's tables, its defects included.
    #[serde(default)]
    compat: bool,
    /// Name of the job.
    job: Option<String>,
    /// Seed of the Monte Carlo modes; 1.
    seed: Option<u64>,
}

/// A model with the parameters that differ from its defaults.
#[derive(Deserialize, ToSchema)]
#[expect(dead_code, reason = "describes the API")]
pub(super) struct ModelBody {
    /// Name of the model's class.
    #[schema(example = "Facet_BRDF_Model")]
    model: String,
    /// Dotted names with values, or a list of pairs.
    #[schema(example = json!({"substrate": "(1.5,0)", "sdf.s": 0.3}))]
    parameters: Option<Value>,
    /// Texts of data files by the names that parameters give them.
    files: Option<BTreeMap<String, String>>,
}

/// The input of `mist eval`: the keys of a material beside those of the evaluation.
#[derive(Deserialize, ToSchema)]
#[expect(dead_code, reason = "describes the API")]
pub(super) struct EvalRequest {
    /// Name of the model's class; it or `program` is required.
    #[schema(example = "Facet_BRDF_Model")]
    model: Option<String>,
    /// Dotted names with values, or a list of pairs.
    #[schema(example = json!({"substrate": "(1.5,0)"}))]
    parameters: Option<Value>,
    /// The text of a program whose first step is the material, in place of `model`.
    program: Option<String>,
    /// The program has NIST's numbers, defects included.
    compat: Option<bool>,
    /// `psps`, `xyxy` or `plane`.
    #[schema(example = "psps")]
    basis: Option<String>,
    /// Directions at which the model is evaluated.
    geometries: Vec<EvaluationAngles>,
    /// Texts of data files by the names that parameters give them.
    files: Option<BTreeMap<String, String>>,
}

/// One geometry, radians.
#[derive(Deserialize, ToSchema)]
#[schema(as = Angles)]
#[expect(dead_code, reason = "describes the API")]
pub(super) struct EvaluationAngles {
    /// Polar angle of incidence.
    #[schema(example = 0.5)]
    theta_i: f64,
    /// Polar angle of scattering.
    #[schema(example = 0.2)]
    theta_s: f64,
    /// Azimuth of scattering; 0 is the specular side.
    #[schema(example = 0.0)]
    phi_s: f64,
    /// Rotation of the sample.
    rotation: Option<f64>,
}

/// The output of `mist eval`.
#[derive(Serialize, ToSchema)]
pub(super) struct EvalAnswer {
    /// One Mueller matrix (1/sr) per geometry, row by row; what is not finite is a text.
    mueller: Vec<Vec<Value>>,
    /// Defects of NIST's library that a sound run stepped around.
    defects: Option<Vec<String>>,
    /// Limits of the model that the parameters pass.
    limits: Option<Vec<String>>,
    /// Numbers that are probably not what was meant.
    warnings: Option<Vec<WarningBody>>,
}

/// A remark on a result that is probably not what was meant.
#[derive(Serialize, ToSchema)]
#[schema(as = Warning)]
pub(super) struct WarningBody {
    /// Kind of mistake; stable.
    code: String,
    /// The message.
    message: String,
    /// A remedy.
    help: Option<String>,
}
