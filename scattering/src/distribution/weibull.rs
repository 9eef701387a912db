//! Weibull density of the diameter.
//!
//! $$ p(d) = \frac{e}{s}\left(\frac{d}{s}\right)^{e-1} \exp\left[-(d/s)^e\right] $$
//!
//! s is the scale (µm), e the exponent.
//!
//! W. Weibull, J. Appl. Mech. 18, 293 (1951).

use super::{Distribution, positive};
use crate::spec::{Class, Laws, Parameter, Spec};

/// Name, parameters and constructor of a [`Weibull`] distribution.
pub const SPEC: Spec<dyn Distribution> = Spec {
    class: Class {
        name: "Weibull_Distribution",
        parent: "Distribution",
        summary: "Weibull distribution of the diameter",
        equation: "p = (e/s)(d/s)^(e-1) exp(-(d/s)^e)",
        source: "weibull-1951",
        params: &[&[
            Parameter::number("scale", 10.0, "um", "Diameter s that a fraction 1-1/e stays below"),
            Parameter::number("exponent", 4.0, "1", "Exponent e"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let (scale, exponent) = (positive(node, "scale")?, positive(node, "exponent")?);
        Ok(Box::new(Weibull { scale, exponent }))
    },
};

/// A Weibull distribution.
#[derive(Clone, Copy, Debug)]
pub struct Weibull {
    scale: f64,
    exponent: f64,
}

impl Distribution for Weibull {
    fn density(&self, d: f64) -> f64 {
        if d <= 0.0 {
            return 0.0;
        }
        let (u, e) = (d / self.scale, self.exponent);
        e / self.scale * u.powf(e - 1.0) * (-u.powf(e)).exp()
    }
}
