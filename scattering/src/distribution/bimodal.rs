//! Mixture of two densities: p = f p_A + (1 − f) p_B.

use super::Distribution;
use crate::{
    distribution::FAMILY,
    spec::{Class, Laws, Parameter, ParameterError, Spec},
};

/// Name, parameters and constructor of a [`Bimodal`] distribution.
pub const SPEC: Spec<dyn Distribution> = Spec {
    class: Class {
        name: "Bimodal_Distribution",
        parent: "Distribution",
        summary: "Mixture of two distributions",
        equation: "p = f pA + (1-f) pB",
        source: "aitchison-brown-1957",
        params: &[&[
            part("distributionA", "First distribution"),
            part("distributionB", "Second distribution"),
            Parameter::number("fractionA", 0.5, "1", "Fraction f of the first, 0 to 1"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let fraction = node.number("fractionA");
        if !(0.0..=1.0).contains(&fraction) {
            return Err(ParameterError::new("fractionA", format!("{fraction} is not from 0 to 1")));
        }
        Ok(Box::new(Bimodal {
            a: node.member::<dyn Distribution>("distributionA")?,
            b: node.member::<dyn Distribution>("distributionB")?,
            fraction,
        }))
    },
};

const fn part(name: &'static str, doc: &'static str) -> Parameter {
    Parameter::member(name, &FAMILY, "Log_Normal_Distribution", doc)
}

/// A mixture of two distributions.
pub struct Bimodal {
    a: Box<dyn Distribution>,
    b: Box<dyn Distribution>,
    fraction: f64,
}

impl Distribution for Bimodal {
    fn density(&self, d: f64) -> f64 {
        self.fraction * self.a.density(d) + (1.0 - self.fraction) * self.b.density(d)
    }
}
