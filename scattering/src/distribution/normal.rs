//! Normal density of the diameter.
//!
//! $$ p(d) = \frac{1}{\sigma\sqrt{2\pi}} \exp\left[-\frac{(d - \bar d)^2}{2\sigma^2}\right] $$
//!
//! The part at negative diameters is lost to every sum over sizes.
//!
//! J. Aitchison and J. A. C. Brown, *The Lognormal Distribution* (Cambridge, 1957).

use std::f64::consts::TAU;

use super::{Distribution, positive};
use crate::spec::{Class, Laws, Parameter, Spec};

/// Name, parameters and constructor of a [`Normal`] distribution.
pub const SPEC: Spec<dyn Distribution> = Spec {
    class: Class {
        name: "Normal_Distribution",
        parent: "Distribution",
        summary: "Normal distribution of the diameter",
        equation: "p = exp(-(d-mean)^2/(2 sigma^2))/(sigma sqrt(2 pi))",
        source: "aitchison-brown-1957",
        params: &[&[
            Parameter::number("mean", 10.0, "um", "Mean diameter"),
            Parameter::number("sigma", 5.0, "um", "Standard deviation of the diameter"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        Ok(Box::new(Normal { mean: node.number("mean"), sigma: positive(node, "sigma")? }))
    },
};

/// A normal distribution.
#[derive(Clone, Copy, Debug)]
pub struct Normal {
    mean: f64,
    sigma: f64,
}

impl Distribution for Normal {
    fn density(&self, d: f64) -> f64 {
        let z = (d - self.mean) / self.sigma;
        (-0.5 * z * z).exp() / (self.sigma * TAU.sqrt())
    }
}
