//! Notation of classes and evaluation of models in the tests.

use std::sync::Arc;

use scattering::{
    Basis, Direction, Geometry, Mode, Model, Mueller, ParameterNode, ParameterValue, Stokes,
    models, optics::RefractiveIndex, registry::find_class,
};

/// The class `name` with the parameters given, the others at their defaults.
pub(crate) fn node(name: &str, values: &[(&str, ParameterValue)]) -> ParameterNode {
    let class = find_class(name).unwrap_or_else(|| panic!("class {name}"));
    values.iter().fold(ParameterNode::with_defaults(class, Mode::Sound), |node, (name, value)| {
        node.with(name, value.clone()).unwrap()
    })
}

pub(crate) fn number(x: f64) -> ParameterValue {
    ParameterValue::Number(x)
}

pub(crate) fn integer(i: i32) -> ParameterValue {
    ParameterValue::Integer(i)
}

pub(crate) fn index(n: f64, k: f64) -> ParameterValue {
    ParameterValue::Index(RefractiveIndex::constant(n, k))
}

pub(crate) fn text(text: &str) -> ParameterValue {
    ParameterValue::Text(text.into())
}

pub(crate) fn member(name: &str, values: &[(&str, ParameterValue)]) -> ParameterValue {
    ParameterValue::Member(Arc::new(node(name, values)))
}

pub(crate) fn model(name: &str, values: &[(&str, ParameterValue)]) -> Model {
    models::build(&node(name, values)).unwrap()
}

/// The direction whose propagation vector has these lateral components.
pub(crate) fn direction(x: f64, y: f64) -> Direction {
    Direction::new(x.hypot(y).asin(), y.atan2(x))
}

/// BRDF times cos θ_s: what NIST calls a differential integral is its product with two vectors.
pub(crate) fn projected(model: &Model, theta_i: f64, rotation: f64, to: &Direction) -> Mueller {
    let at = Geometry { theta_i, theta_s: to.theta(), phi_s: to.phi(), rotation };
    model.mueller(&at, Basis::Psps) * to.cos
}

/// Detector · (M · source).
pub(crate) fn seen(m: &Mueller, source: [f64; 4], detector: [f64; 4]) -> f64 {
    Stokes(detector).dot(&(*m * Stokes(source)))
}

/// A line grating model with a narrow cone, for tests that look at one order at a time.
pub(crate) struct LineStack {
    pub(crate) lambda: f64,
    pub(crate) period: f64,
    pub(crate) order: i32,
    pub(crate) substrate: (f64, f64),
}

/// Half angle of the cones in these tests; no two orders are that close.
pub(crate) const ALPHA: f64 = 1e-3;

impl LineStack {
    /// The model of `kind` 0–3 with a grating of class `class`.
    pub(crate) fn model(&self, kind: i32, class: &str, values: &[(&str, ParameterValue)]) -> Model {
        let substrate = index(self.substrate.0, self.substrate.1);
        let mut all = vec![("period", number(self.period)), ("medium_t", substrate.clone())];
        all.extend(values.iter().map(|(name, value)| (*name, value.clone())));
        model(
            "RCW_BRDF_Model",
            &[
                ("lambda", number(self.lambda)),
                ("alpha", number(ALPHA)),
                ("order", integer(self.order)),
                ("substrate", substrate),
                ("type", integer(kind)),
                ("grating", member(class, &all)),
            ],
        )
    }
}

/// Mueller efficiency of the order whose lateral direction is (x, y).
pub(crate) fn efficiency(model: &Model, theta_i: f64, rotation: f64, x: f64, y: f64) -> Mueller {
    projected(model, theta_i, rotation, &direction(x, y)) * (std::f64::consts::PI * ALPHA * ALPHA)
}
