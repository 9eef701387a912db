//! The same density 1 for every slope: the bare geometry of a facet model, not normalized.

use super::SlopeDistribution;
use crate::spec::{Class, Laws, Spec};

/// Name and constructor of the class.
pub const SPEC: Spec<dyn SlopeDistribution> = Spec {
    class: Class {
        name: "Unit_Slope_Distribution_Function",
        parent: "Slope_Distribution_Function",
        summary: "Density 1 everywhere, not normalized",
        equation: "S = 1",
        source: "torrance-1967",
        params: &[],
        laws: Laws::NONE,
    },
    build: |_| Ok(Box::new(UnitSlope)),
};

struct UnitSlope;

impl SlopeDistribution for UnitSlope {
    fn density(&self, _: f64, _: f64) -> f64 {
        1.0
    }
}
