//! Reflectance given by a number, a table or a formula of wavelength.

use super::Reflectance;
use crate::{
    optics::RealFunction,
    spec::{Class, Laws, Parameter, Spec},
};

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
    build: |node| Ok(Box::new(TableReflectance { table: node.table("table").clone() })),
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
