//! Reference values of models, computed by NIST's library, through materials and `eval`.
//!
//! `reference/models.json` states their origin.

use std::{collections::BTreeMap, fs, path::Path};

use mist_engine::material::eval::eval;
use rayon::prelude::*;
use scattering::Mode;
use serde::Deserialize;
use serde_json::{Value, json};

/// Largest difference, relative to the largest element: rounding of the two implementations.
const TOLERANCE: f64 = 1e-11;

#[derive(Deserialize)]
struct Reference {
    header: Header,
    brdf: Vec<Case>,
}

#[derive(Deserialize)]
struct Header {
    files: BTreeMap<String, String>,
}

#[derive(Deserialize)]
struct Case {
    id: String,
    model: String,
    params: Vec<(String, String)>,
    thetai: f64,
    thetas: f64,
    phis: f64,
    rotation: f64,
    basis: String,
    mueller: Vec<Value>,
}

fn reference() -> Reference {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/models.json");
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| value.as_str().unwrap().parse().unwrap())
}

/// The relative difference of a case; infinite where only one side is finite.
fn difference(case: &Case, files: &BTreeMap<String, String>) -> Result<f64, String> {
    let request = json!({
        "model": case.model, "parameters": case.params, "basis": case.basis, "files": files,
        "geometries": [{"theta_i": case.thetai, "theta_s": case.thetas, "phi_s": case.phis,
                        "rotation": case.rotation}],
    });
    let answer =
        eval(&request.to_string(), Mode::Compat, None).map_err(|error| error.to_string())?;
    let got = answer.mueller[0].map(|x| x.0);
    let want: Vec<f64> = case.mueller.iter().map(number).collect();
    let largest = want.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let off = got.iter().zip(&want).map(|(x, y)| match (x.is_finite(), y.is_finite()) {
        (true, true) => (x - y).abs(),
        (false, false) => 0.0,
        _ => f64::INFINITY,
    });
    let off = off.fold(0.0, f64::max);
    Ok(if off == 0.0 { 0.0 } else { off / largest })
}

#[test]
fn every_reference_value_is_reproduced_under_compat() {
    let Reference { header, brdf } = reference();
    assert_eq!(brdf.len(), 363);
    let wrong: Vec<String> = brdf
        .par_iter()
        .filter_map(|case| match difference(case, &header.files) {
            Ok(off) if off <= TOLERANCE => None,
            Ok(off) => Some(format!("{}: {off:.1e}", case.id)),
            Err(error) => Some(format!("{}: {error}", case.id)),
        })
        .collect();
    assert!(wrong.is_empty(), "{} of {}\n{}", wrong.len(), brdf.len(), wrong.join("\n"));
}
