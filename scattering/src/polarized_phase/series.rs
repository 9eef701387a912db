//! A phase matrix given by its expansion in Wigner functions.
//!
//! `a1` … `b2` list α₁, α₂, α₃, α₄, β₁, β₂ for l = 0, 1, 2, …, separated by blanks, in the sense of
//! [`crate::doubling::expansion`]; missing ones are 0; an empty `a1` is 1. All are divided by α₁,₀.
//!
//! J. W. Hovenier, C. van der Mee and H. Domke, *Transfer of Polarized Light in Planetary
//! Atmospheres* (Kluwer, 2004), 2.8.

use std::f64::consts::FRAC_1_PI;

use super::{PolarizedPhase, coefficient};
use crate::{
    Mueller, ParameterError, ParameterNode,
    doubling::expansion::PhaseExpansion,
    spec::{Class, Laws, Parameter, ParameterKind, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn PolarizedPhase> = Spec {
    class: Class {
        name: "Expansion_Phase_Function",
        parent: "Polarized_Phase_Function",
        summary: "Phase matrix given by expansion coefficients",
        equation: "4 pi P00 = sum a1_l d^l_00(theta)",
        source: "hovenier-2004",
        params: &[&[
            list("a1", "alpha_1 for l = 0, 1, 2, ...; empty: 1"),
            list("a2", "alpha_2"),
            list("a3", "alpha_3"),
            list("a4", "alpha_4"),
            list("b1", "beta_1"),
            list("b2", "beta_2"),
            Parameter::number("scattering", 0.1, "1/um", "Scattering coefficient"),
            Parameter::number("absorption", 0.0, "1/um", "Absorption coefficient"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let lists = ["a1", "a2", "a3", "a4", "b1", "b2"].map(|name| numbers(node, name));
        let mut lists: Vec<Vec<f64>> = lists.into_iter().collect::<Result<_, _>>()?;
        if lists[0].is_empty() {
            lists[0].push(1.0);
        }
        let whole = lists[0][0];
        if !(whole > 0.0) {
            return Err(ParameterError::new("a1", "its first number is not positive"));
        }
        let longest = lists.iter().map(Vec::len).max().unwrap_or(1);
        let term = |l: usize| std::array::from_fn(|k| lists[k].get(l).map_or(0.0, |x| x / whole));
        Ok(Box::new(PhaseSeries {
            series: PhaseExpansion { terms: (0..longest).map(term).collect() },
            absorption: coefficient(node, "absorption")?,
            scattering: coefficient(node, "scattering")?,
        }))
    },
};

const fn list(name: &'static str, doc: &'static str) -> Parameter {
    Parameter { name, kind: ParameterKind::Text, unit: "1", doc }
}

/// Longer lists are refused: spheres of x = 1000 have 2000 terms.
const LONGEST: usize = 4096;

fn numbers(node: &ParameterNode, name: &str) -> Result<Vec<f64>, ParameterError> {
    let mut found = Vec::new();
    for word in node.text(name).split_whitespace() {
        let number = word.parse::<f64>().ok().filter(|x| x.is_finite());
        let wrong = || ParameterError::new(name, format!("{word:?} is not a number"));
        found.push(number.ok_or_else(wrong)?);
    }
    if found.len() > LONGEST {
        return Err(ParameterError::new(name, format!("more than {LONGEST} numbers")));
    }
    Ok(found)
}

/// A phase matrix with its expansion.
struct PhaseSeries {
    series: PhaseExpansion,
    absorption: f64,
    scattering: f64,
}

impl PolarizedPhase for PhaseSeries {
    fn at_cosine(&self, cos: f64) -> Mueller {
        let elements = self.series.at_cosine(cos.clamp(-1.0, 1.0));
        let [a1, a2, a3, a4, b1, b2] = elements.map(|x| 0.25 * FRAC_1_PI * x);
        Mueller([[a1, b1, 0.0, 0.0], [b1, a2, 0.0, 0.0], [0.0, 0.0, a3, b2], [0.0, 0.0, -b2, a4]])
    }

    fn absorption(&self) -> f64 {
        self.absorption
    }

    fn scattering(&self) -> f64 {
        self.scattering
    }
}
