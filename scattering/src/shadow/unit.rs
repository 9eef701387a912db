//! No shadowing.

use super::Shadow;
use crate::{
    Direction, Incidence,
    spec::{Class, Laws, Spec},
};

/// Name and constructor of the class.
pub const SPEC: Spec<dyn Shadow> = Spec {
    class: Class {
        name: "Unit_Shadow_Function",
        parent: "Shadow_Function",
        summary: "No shadowing",
        equation: "G = 1",
        source: "torrance-1967",
        params: &[],
        laws: Laws::NONE,
    },
    build: |_| Ok(Box::new(UnitShadow)),
};

struct UnitShadow;

impl Shadow for UnitShadow {
    fn fraction(&self, _: &Incidence, _: &Direction) -> f64 {
        1.0
    }
}
