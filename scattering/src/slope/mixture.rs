//! Mixture of two densities of slopes.
//!
//! $$ S = (1-f)\,S_1 + f\,S_2 $$

use super::SlopeDistribution;
use crate::{
    slope::FAMILY,
    spec::{Class, Laws, Parameter, ParameterError, Spec},
};

const fn part(name: &'static str, doc: &'static str) -> Parameter {
    Parameter::member(name, &FAMILY, "Exponential_Slope_Distribution_Function", doc)
}

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn SlopeDistribution> = Spec {
    class: Class {
        name: "Two_Slope_Distribution_Function",
        parent: "Slope_Distribution_Function",
        summary: "Mixture of two densities",
        equation: "S = (1-fract) S1 + fract S2",
        source: "torrance-1967",
        params: &[&[
            part("s1", "First density"),
            part("s2", "Second density"),
            Parameter::number("fract", 0.5, "1", "Share of the second density"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let fraction = node.number("fract");
        if !(0.0..=1.0).contains(&fraction) {
            return Err(ParameterError::new("fract", format!("{fraction} is not from 0 to 1")));
        }
        let (first, second) = (node.member("s1")?, node.member("s2")?);
        Ok(Box::new(SlopeMixture { first, second, fraction }))
    },
};

struct SlopeMixture {
    first: Box<dyn SlopeDistribution>,
    second: Box<dyn SlopeDistribution>,
    /// f.
    fraction: f64,
}

impl SlopeMixture {
    fn mix(&self, first: f64, second: f64) -> f64 {
        (1.0 - self.fraction) * first + self.fraction * second
    }
}

impl SlopeDistribution for SlopeMixture {
    fn density(&self, x: f64, y: f64) -> f64 {
        self.mix(self.first.density(x, y), self.second.density(x, y))
    }

    fn deviations(&self) -> Option<(f64, f64)> {
        let ((x1, y1), (x2, y2)) = (self.first.deviations()?, self.second.deviations()?);
        Some((self.mix(x1 * x1, x2 * x2).sqrt(), self.mix(y1 * y1, y2 * y2).sqrt()))
    }
}
