//! Reflectance given by a number, a table or a formula of wavelength.

use super::Reflectance;
use crate::{
    Mode,
    notice::ModelLimit,
    optics::RealFunction,
    spec::{Class, Laws, Parameter, ParameterError, Spec},
};

/// Reflectances up to here are measured on white plates.
const LARGEST: f64 = 1.02;

/// Name, parameters and constructor of a [`TableReflectance`].
pub const SPEC: Spec<dyn Reflectance> = Spec {
    class: Class {
        name: "Table_Reflectance",
        parent: "Reflectance",
        summary: "Reflectance from a table or a constant",
        equation: "R = table(lambda)",
        source: "nicodemus-1977",
        params: &[&[Parameter::table("table", 1.0, "1", "Reflectance against wavelength in um")]],
        laws: Laws::NONE,
    },
    build: |node| {
        let table = node.table("table").clone();
        if node.mode == Mode::Sound && table.dips_below_zero() {
            let problem = "a reflectance is negative; subtract the dark signal, or write 0";
            return Err(ParameterError::new("table", problem));
        }
        if table.ordinates().any(|r| r > LARGEST) {
            node.note_limit(ModelLimit::ReflectanceAboveOne);
        }
        Ok(Box::new(TableReflectance { table }))
    },
};

/// A tabulated reflectance.
#[derive(Clone, Debug)]
pub struct TableReflectance {
    table: RealFunction,
}

impl Reflectance for TableReflectance {
    fn at(&self, lambda: f64) -> f64 {
        self.table.at(lambda)
    }
}
