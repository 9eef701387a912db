//! Two films.

use super::{Film, Stack, check_thickness};
use crate::spec::{Class, Laws, Parameter, Spec};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<Stack> = Spec {
    class: Class {
        name: "DoubleFilm_StackModel",
        parent: "StackModel",
        summary: "Two films",
        equation: "(n_1, t_1), (n_2, t_2), film 1 next to the substrate",
        source: "born-1999",
        params: &[&[
            Parameter::index("material1", (1.5, 0.0), "Index of the buried film"),
            Parameter::number("thickness1", 0.1, "um", "Thickness of the buried film"),
            Parameter::index("material2", (1.5, 0.0), "Index of the exposed film"),
            Parameter::number("thickness2", 0.1, "um", "Thickness of the exposed film"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let film = |material: &str, name: &str| {
            let thickness = check_thickness(name, node.number(name))?;
            Ok(Film { index: node.index(material).clone(), thickness })
        };
        let films = vec![film("material1", "thickness1")?, film("material2", "thickness2")?];
        Ok(Box::new(Stack { films }))
    },
};
