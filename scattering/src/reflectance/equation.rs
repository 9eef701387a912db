//! Reflectance given by a formula of the wavelength in µm.

use super::Reflectance;
use crate::optics::FormulaFn;
use crate::spec::{Class, Laws, Parameter, ParameterKind, Spec};

/// Name, parameters and constructor of an [`EquationReflectance`].
pub const SPEC: Spec<dyn Reflectance> = Spec {
    class: Class {
        name: "Equation_Reflectance",
        parent: "Reflectance",
        summary: "Reflectance from a formula of wavelength",
        equation: "R = expression(x), x = lambda in um",
        source: "nicodemus-1977",
        params: &[&[Parameter {
            name: "expression",
            kind: ParameterKind::Formula(1.0),
            unit: "1",
            doc: "Reflectance as a formula of x, the wavelength in um",
        }]],
        laws: Laws::NONE,
    },
    build: |node| {
        Ok(Box::new(EquationReflectance { expression: node.formula("expression").clone() }))
    },
};

/// A reflectance given by a formula.
pub struct EquationReflectance {
    expression: FormulaFn,
}

impl Reflectance for EquationReflectance {
    fn at(&self, lambda: f64) -> f64 {
        (self.expression)(lambda)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::{Mode, ParameterNode, ParameterValue, spec};

    #[test]
    fn formula_is_asked_at_the_wavelength() {
        let node = ParameterNode::with_defaults(&SPEC.class, Mode::Sound)
            .with("expression", ParameterValue::Formula(Arc::new(|x| 0.1 + 0.5 * x)))
            .unwrap();
        let reflectance = spec::build::<dyn Reflectance>(&node).unwrap();
        assert_eq!(reflectance.at(0.4), 0.1 + 0.5 * 0.4);
    }
}
