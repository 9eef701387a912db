//! One film.

use super::{Film, Stack, check_thickness};
use crate::spec::{Class, Laws, Parameter, Spec};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<Stack> = Spec {
    class: Class {
        name: "SingleFilm_StackModel",
        parent: "StackModel",
        summary: "One film",
        equation: "(n, t)",
        source: "born-1999",
        params: &[&[
            Parameter::index("material", (1.5, 0.0), "Index of the film"),
            Parameter::number("thickness", 0.1, "um", "Thickness of the film"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let thickness = check_thickness("thickness", node.number("thickness"))?;
        let index = node.index("material").clone();
        Ok(Box::new(Stack { films: vec![Film { index, thickness }] }))
    },
};
