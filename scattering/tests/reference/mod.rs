//! The reference numbers of `tests/reference/models.json`, computed by NIST's library, and what
//! the test of a group of models needs to compare with them.
//!
//! Parameters stand in the file as a program would write them; [`node`] gives them their types.
//! The language itself lives in another crate, so only the forms that occur in the file are read.

// Each test binary compiles this module and uses its own part of it.
#![allow(dead_code, unused_imports)]

use std::sync::LazyLock;

use scattering::{Basis, Geometry, Mode, Mueller, ParameterNode, models};
use serde_json::Value as Json;

mod text;

pub(crate) use text::{films, node};

/// The file, read once.
pub(crate) static FILE: LazyLock<Json> = LazyLock::new(|| {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/reference/models.json");
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
});

/// The library's own rounding: the specification and the library agree to 9·10⁻¹³ for facets and
/// to 10⁻¹⁴ for all else.
pub(crate) const TOLERANCE: f64 = 1e-11;

/// One matrix of the library.
pub(crate) struct ReferenceCase {
    /// Name of the case.
    pub(crate) id: String,
    /// The model, in compat mode.
    pub(crate) node: ParameterNode,
    /// Angles.
    pub(crate) at: Geometry,
    /// Basis of the matrix.
    pub(crate) basis: Basis,
    /// The library's matrix.
    pub(crate) expected: Mueller,
}

/// All cases of the model.
pub(crate) fn cases(model: &str) -> Vec<ReferenceCase> {
    list(&FILE["brdf"]).iter().filter(|case| case["model"] == model).map(case).collect()
}

/// Compares every case of these models with the library; each model must have cases.
pub(crate) fn check(models: &[&str]) {
    check_within(models, TOLERANCE);
}

/// The same with another largest difference over largest element.
pub(crate) fn check_within(names: &[&str], tolerance: f64) {
    let mut wrong = Vec::new();
    for name in names {
        let cases = cases(name);
        assert!(cases.len() >= 3, "{name} has {} cases", cases.len());
        for case in cases {
            let model = models::build(&case.node).unwrap_or_else(|e| panic!("{}: {e}", case.id));
            let difference =
                relative_difference(&model.mueller(&case.at, case.basis), &case.expected);
            if difference.is_nan() || difference > tolerance {
                wrong.push(format!("{}: {difference:e}", case.id));
            }
        }
    }
    assert!(wrong.is_empty(), "{} cases differ:\n{}", wrong.len(), wrong.join("\n"));
}

/// max|Δ| / max|expected|; 0 for two zero matrices, NaN only if one of them has NaN alone.
pub(crate) fn relative_difference(got: &Mueller, expected: &Mueller) -> f64 {
    let pairs = || got.0.iter().flatten().zip(expected.0.iter().flatten());
    if pairs().any(|(g, e)| g.is_nan() != e.is_nan()) {
        return f64::NAN;
    }
    let largest = (*got - *expected).largest();
    if largest == 0.0 { 0.0 } else { largest / expected.largest() }
}

/// The checks of a class apart from models, e.g. `slope_distribution`.
pub(crate) fn components(section: &str) -> &'static [Json] {
    list(&FILE["components"][section])
}

/// The node of a check that names its `model` and `params`.
pub(crate) fn component_node(check: &Json, mode: Mode) -> ParameterNode {
    node(check["model"].as_str().unwrap(), &params(check), mode)
}

/// Asserts that `got` is `expected` within `tolerance` times |expected|.
pub(crate) fn assert_close(got: f64, expected: f64, tolerance: f64, what: &Json) {
    assert!(
        (got - expected).abs() <= tolerance * expected.abs(),
        "{got:e} is not {expected:e}: {what}"
    );
}

/// The real number at `json`, which may be the text `nan` or `inf`.
pub(crate) fn number(json: &Json) -> f64 {
    json.as_f64().unwrap_or_else(|| json.as_str().unwrap().parse().unwrap())
}

/// The elements of a list.
pub(crate) fn list(json: &'static Json) -> &'static [Json] {
    json.as_array().unwrap()
}

/// The sixteen numbers of a matrix.
pub(crate) fn mueller(json: &Json) -> Mueller {
    let numbers: Vec<f64> = json.as_array().unwrap().iter().map(number).collect();
    Mueller::from_row_major(numbers.try_into().unwrap())
}

/// The angles of a check.
pub(crate) fn geometry(json: &Json) -> Geometry {
    Geometry {
        theta_i: number(&json["thetai"]),
        theta_s: number(&json["thetas"]),
        phi_s: number(&json["phis"]),
        rotation: number(&json["rotation"]),
    }
}

fn params(json: &Json) -> Vec<(&str, &str)> {
    json["params"]
        .as_array()
        .unwrap()
        .iter()
        .map(|pair| (pair[0].as_str().unwrap(), pair[1].as_str().unwrap()))
        .collect()
}

fn case(json: &Json) -> ReferenceCase {
    let id = json["id"].as_str().unwrap().to_owned();
    ReferenceCase {
        node: node(json["model"].as_str().unwrap(), &params(json), Mode::Compat),
        at: geometry(json),
        basis: Basis::from_name(json["basis"].as_str().unwrap()).unwrap(),
        expected: mueller(&json["mueller"]),
        id,
    }
}
