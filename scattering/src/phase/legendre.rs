//! Phase function given by six Legendre coefficients.
//!
//! $$ p = \frac{1}{4\pi} \sum_{l=0}^{5} (2l+1)\,c_l\,P_l(\cos\theta) $$
//!
//! c_0 = 1 normalizes it, c_1 is the mean cosine. A truncated series can be negative.
//!
//! S. Chandrasekhar, *Radiative Transfer* (Dover, 1960), §3.

use std::f64::consts::FRAC_1_PI;

use super::Phase;
use crate::{
    Defect,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`LegendrePhase`] phase function.
pub const SPEC: Spec<dyn Phase> = Spec {
    class: Class {
        name: "Legendre_Phase_Function",
        parent: "Phase_Function",
        summary: "Six Legendre coefficients",
        equation: "p = sum (2l+1) c_l P_l(cos(theta))/(4 pi)",
        source: "chandrasekhar-1960",
        params: &[&[
            Parameter::number(
                "c0",
                1.0,
                "1",
                "Coefficient of P_0: the integral over all directions",
            ),
            Parameter::number("c1", 0.65, "1", "Coefficient of P_1: the mean cosine"),
            Parameter::number("c2", 0.42, "1", "Coefficient of P_2"),
            Parameter::number("c3", 0.0, "1", "Coefficient of P_3"),
            Parameter::number("c4", 0.0, "1", "Coefficient of P_4"),
            Parameter::number("c5", 0.0, "1", "Coefficient of P_5"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let norm = if node.reproduces(Defect::PhaseNorm) { 1.0 } else { 0.25 * FRAC_1_PI };
        let mut terms = ["c0", "c1", "c2", "c3", "c4", "c5"].map(|name| node.number(name));
        for (l, term) in terms.iter_mut().enumerate() {
            *term *= norm * (2 * l + 1) as f64;
        }
        Ok(Box::new(LegendrePhase { terms }))
    },
};

/// A Legendre series.
#[derive(Clone, Copy, Debug)]
pub struct LegendrePhase {
    /// (2l+1) c_l/4π.
    terms: [f64; 6],
}

impl Phase for LegendrePhase {
    fn at_cosine(&self, cos: f64) -> f64 {
        // P_(l−1) and P_l.
        let (mut previous, mut legendre, mut sum) = (0.0, 1.0, 0.0);
        for (l, term) in self.terms.iter().enumerate() {
            sum += term * legendre;
            let l = l as f64;
            let next = ((2.0 * l + 1.0) * cos * legendre - l * previous) / (l + 1.0);
            (previous, legendre) = (legendre, next);
        }
        sum
    }
}
