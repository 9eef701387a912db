//! Log-normal density of the diameter.
//!
//! $$ p(d) = \frac{1}{d\,\sigma\sqrt{2\pi}} \exp\left[-\frac{(\ln d - \ln m)^2}{2\sigma^2}\right] $$
//!
//! m is the median diameter (µm), σ the standard deviation of ln d.
//!
//! J. Aitchison and J. A. C. Brown, *The Lognormal Distribution* (Cambridge, 1957).

use std::f64::consts::TAU;

use super::{Distribution, positive};
use crate::spec::{Class, Laws, Parameter, Spec};

/// Name, parameters and constructor of a [`LogNormal`] distribution.
pub const SPEC: Spec<dyn Distribution> = Spec {
    class: Class {
        name: "Log_Normal_Distribution",
        parent: "Distribution",
        summary: "Normal distribution of the logarithm of the diameter",
        equation: "p = exp(-(ln(d/median))^2/(2 sigma^2))/(d sigma sqrt(2 pi))",
        source: "aitchison-brown-1957",
        params: &[&[
            Parameter::number("sigma", 1.0, "1", "Standard deviation of ln d"),
            Parameter::number("median", 10.0, "um", "Median diameter"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let (sigma, median) = (positive(node, "sigma")?, positive(node, "median")?);
        Ok(Box::new(LogNormal { sigma, ln_median: median.ln() }))
    },
};

/// A log-normal distribution.
#[derive(Clone, Copy, Debug)]
pub struct LogNormal {
    sigma: f64,
    ln_median: f64,
}

impl Distribution for LogNormal {
    fn density(&self, d: f64) -> f64 {
        if d <= 0.0 {
            return 0.0;
        }
        let z = (d.ln() - self.ln_median) / self.sigma;
        (-0.5 * z * z).exp() / (d * self.sigma * TAU.sqrt())
    }
}
