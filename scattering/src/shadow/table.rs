//! Shadowing as a product of two values of one function of the polar angle.
//!
//! $$ G = T(\theta_i)\,T(\theta_s) $$
//!
//! The angles are in radians.

use super::Shadow;
use crate::{
    Direction, Incidence,
    optics::RealFunction,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Shadow> = Spec {
    class: Class {
        name: "Table_Shadow_Function",
        parent: "Shadow_Function",
        summary: "Product of two values of a table",
        equation: "G = T(ti) T(ts)",
        source: "torrance-1967",
        params: &[&[Parameter::table("T", 1.0, "1", "Function of the polar angle in radians")]],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(TableShadow { table: node.table("T").clone() })),
};

struct TableShadow {
    table: RealFunction,
}

impl Shadow for TableShadow {
    fn fraction(&self, incidence: &Incidence, direction: &Direction) -> f64 {
        self.table.at(incidence.theta()) * self.table.at(direction.theta())
    }
}
