//! Modified gamma density of the radius, as a density of the diameter.
//!
//! $$ p(d) = \frac12\,\frac{\gamma\,\Lambda^{(1+\mu)/\gamma}}{\Gamma[(1+\mu)/\gamma]}\,
//!    r^\mu e^{-\Lambda r^\gamma}, \qquad r = d/2 $$
//!
//! `--compat` leaves the ½ out, as if the density were one of the radius.
//!
//! D. Deirmendjian, *Electromagnetic Scattering on Spherical Polydispersions* (Elsevier, 1969).

use super::{Distribution, positive};
use crate::{
    Defect,
    spec::{Class, Laws, Parameter, ParameterError, Spec},
};

/// Name, parameters and constructor of a [`ModifiedGamma`] distribution.
pub const SPEC: Spec<dyn Distribution> = Spec {
    class: Class {
        name: "Modified_Gamma_Distribution",
        parent: "Distribution",
        summary: "Modified gamma distribution of the radius",
        equation: "p = gamma Lambda^((1+mu)/gamma)/(2 Gamma((1+mu)/gamma)) r^mu exp(-Lambda r^gamma), r = d/2",
        source: "deirmendjian-1969",
        params: &[&[
            Parameter::number("mu", 8.0, "1", "Exponent of the radius, above -1"),
            Parameter::number("Lambda", 0.0417, "um^-gamma", "Strength of the exponential fall"),
            Parameter::number("gamma", 3.0, "1", "Exponent of the radius in the exponential"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let mu = node.number("mu");
        if !(mu > -1.0 && mu.is_finite()) {
            return Err(ParameterError::new("mu", format!("{mu} is not above -1")));
        }
        let (lambda, gamma) = (positive(node, "Lambda")?, positive(node, "gamma")?);
        let order = (1.0 + mu) / gamma;
        let of_radius = gamma.ln() + order * lambda.ln() - libm::lgamma(order);
        let half = if node.reproduces(Defect::GammaNorm) { 0.0 } else { 0.5f64.ln() };
        Ok(Box::new(ModifiedGamma { mu, lambda, gamma, ln_norm: of_radius + half }))
    },
};

/// A modified gamma distribution.
#[derive(Clone, Copy, Debug)]
pub struct ModifiedGamma {
    mu: f64,
    lambda: f64,
    gamma: f64,
    ln_norm: f64,
}

impl Distribution for ModifiedGamma {
    fn density(&self, d: f64) -> f64 {
        if d <= 0.0 {
            return 0.0;
        }
        let r = 0.5 * d;
        (self.ln_norm + self.mu * r.ln() - self.lambda * r.powf(self.gamma)).exp()
    }
}
