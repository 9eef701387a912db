//! Mueller matrices of a material for single geometries: JSON in, JSON out.

use std::sync::Arc;

use scattering::{Basis, Geometry, Mode, Mueller, Notice, notice::keep_largest};
use serde::{Serialize, Serializer};

use super::MaterialError;
use crate::{
    Files, Warning,
    request::{EvaluationRequest, GeometryAngles, read},
};

/// The answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EvaluationResponse {
    /// One Mueller matrix (1/sr) per geometry, row by row.
    pub mueller: Vec<[JsonNumber; 16]>,
    /// Defects of NIST's library that a sound run stepped around: number and effect.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub defects: Vec<String>,
    /// Limits of the model that the parameters pass.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub limits: Vec<String>,
    /// Numbers that are probably not what was meant.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Warning>,
}

/// A number that JSON shows as it is if it is finite, else as "nan", "inf" or "-inf".
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JsonNumber(pub f64);

impl Serialize for JsonNumber {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            x if x.is_finite() => serializer.serialize_f64(x),
            x if x.is_nan() => serializer.serialize_str("nan"),
            x if x > 0.0 => serializer.serialize_str("inf"),
            _ => serializer.serialize_str("-inf"),
        }
    }
}

/// Answers a request in JSON.
///
/// # Errors
///
/// For texts that are not a request, and as [`Material::prepare`](crate::request::Material::prepare) and
/// [`PreparedMaterial::model`](super::PreparedMaterial::model).
pub fn eval(
    request: &str,
    mode: Mode,
    more_files: Option<Arc<dyn Files + Send + Sync>>,
) -> Result<EvaluationResponse, MaterialError> {
    let request: EvaluationRequest = serde_json::from_str(request)?;
    answer(request, mode, more_files)
}

/// Answers a request.
///
/// # Errors
///
/// As [`eval`].
pub fn answer(
    request: EvaluationRequest,
    mode: Mode,
    more_files: Option<Arc<dyn Files + Send + Sync>>,
) -> Result<EvaluationResponse, MaterialError> {
    let mut warnings = request.warnings();
    let EvaluationRequest { material, basis, geometries } = request;
    let basis: Basis = read("basis", &basis)?;
    let prepared = material.prepare(mode, more_files)?;
    warnings.extend_from_slice(prepared.program_warnings());
    let (model, met) = prepared.own_model()?;
    let row = |m: Mueller| m.to_row_major().map(JsonNumber);
    let at = |a: &GeometryAngles| {
        let GeometryAngles { theta_i, theta_s, phi_s, rotation } = *a;
        model.mueller(&Geometry { theta_i, theta_s, phi_s, rotation }, basis)
    };
    let mueller: Vec<_> = geometries.iter().map(|angles| row(at(angles))).collect();
    warnings.extend(not_finite(&mueller));
    // Models note what they meet in evaluations, too.
    warnings.extend(prepared.warnings());
    let mut met = met.lock().expect("no model panics while it notes").clone();
    keep_largest(&mut met);
    Ok(EvaluationResponse {
        mueller,
        defects: met.iter().filter_map(defect).collect(),
        limits: met.iter().filter_map(limit).collect(),
        warnings,
    })
}

/// A warning of matrices that have values which are not finite.
fn not_finite(mueller: &[[JsonNumber; 16]]) -> Option<Warning> {
    let is_finite = |matrix: &&[JsonNumber; 16]| matrix.iter().all(|x| x.0.is_finite());
    let count = mueller.len() - mueller.iter().filter(is_finite).count();
    let first = mueller.iter().position(|matrix| !is_finite(&matrix))?;
    let message = format!(
        "{count} of {} matrices have values that are not finite, first geometry {}",
        mueller.len(),
        first + 1
    );
    Some(Warning::new("value/not-finite", message).help("leave the exact mirror direction out"))
}

fn defect(notice: &Notice) -> Option<String> {
    match notice {
        Notice::Defect(defect) => Some(defect.to_string()),
        Notice::Limit(_) => None,
    }
}

fn limit(notice: &Notice) -> Option<String> {
    match notice {
        Notice::Defect(_) => None,
        Notice::Limit(limit) => Some(limit.describe().to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_perfect_diffuser_is_one_over_pi() {
        let request = r#"{"model": "Lambertian_BRDF_Model",
            "geometries": [{"theta_i": 0.3, "theta_s": 0.5, "phi_s": 1}]}"#;
        let answer = eval(request, Mode::Sound, None).unwrap();
        assert!((answer.mueller[0][0].0 * std::f64::consts::PI - 1.0).abs() < 1e-15);
        assert!(serde_json::to_string(&answer).unwrap().starts_with(r#"{"mueller":[[0.318"#));
    }

    #[test]
    fn numbers_that_json_does_not_have_are_texts() {
        let numbers = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.5].map(JsonNumber);
        let json = serde_json::to_string(&numbers).unwrap();
        assert_eq!(json, r#"["nan","inf","-inf",0.5]"#);
    }

    #[test]
    fn a_wrong_basis_is_refused_by_name() {
        let request = r#"{"model": "Lambertian_BRDF_Model", "basis": "spsp", "geometries": []}"#;
        assert_eq!(eval(request, Mode::Sound, None).unwrap_err().part(), Some("basis"));
    }
}
