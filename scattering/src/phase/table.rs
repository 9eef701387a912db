//! Phase function tabulated against the scattering angle in degrees; not normalized here.

use super::Phase;
use crate::{
    optics::RealFunction,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`TablePhase`].
pub const SPEC: Spec<dyn Phase> = Spec {
    class: Class {
        name: "Table_Phase_Function",
        parent: "Phase_Function",
        summary: "Tabulated against the scattering angle",
        equation: "p = table(theta)",
        source: "chandrasekhar-1960",
        params: &[&[Parameter::table(
            "table",
            0.07957747,
            "1/sr",
            "Phase function against the scattering angle in degrees",
        )]],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(TablePhase { table: node.table("table").clone() })),
};

/// A tabulated phase function.
#[derive(Clone, Debug)]
pub struct TablePhase {
    table: RealFunction,
}

impl Phase for TablePhase {
    fn at_cosine(&self, cos: f64) -> f64 {
        self.table.at(cos.clamp(-1.0, 1.0).acos().to_degrees())
    }
}
