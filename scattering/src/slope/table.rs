//! Isotropic density of slopes given by a function of the slope.
//!
//! $$ S = T(\zeta), \qquad \zeta^2 = \zeta_x^2 + \zeta_y^2 $$
//!
//! The table is not normalized; beyond its range the end values are held.

use super::SlopeDistribution;
use crate::{
    optics::RealFunction,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn SlopeDistribution> = Spec {
    class: Class {
        name: "Table_Slope_Distribution_Function",
        parent: "Slope_Distribution_Function",
        summary: "Density tabulated against the slope",
        equation: "S = T(zeta)",
        source: "torrance-1967",
        params: &[&[Parameter::table("T", 1.0, "1", "Density as a function of the slope")]],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(TableSlope { table: node.table("T").clone() })),
};

struct TableSlope {
    table: RealFunction,
}

impl SlopeDistribution for TableSlope {
    fn density(&self, x: f64, y: f64) -> f64 {
        self.table.at((x * x + y * y).sqrt())
    }
}
