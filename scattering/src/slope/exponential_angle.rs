//! Exponential density of the tilt angle.
//!
//! $$ S = \frac{P(\theta_n)}{(1+\zeta^2)^2}, \quad \theta_n = \arctan\zeta \qquad (1) $$
//!
//! $$ P = \frac{3}{\pi\sigma^2 N}\,e^{-\sqrt6\,\theta_n/\sigma} \qquad (2) $$
//!
//! $$ N = 1 - e^{-C/\sigma}(1 + C/\sigma), \quad C = \sqrt6\,\pi/2 \qquad (3) $$
//!
//! σ is given in degrees. ∫2πθ P dθ = 1 from 0 to π/2, so ∫∫S is a little below 1 for wide σ.
//! NIST's library uses 3/π, √6 and C with twelve digits
//! ([`Defect::SlopeConstants`](crate::Defect::SlopeConstants)).

use super::{ExponentialConstants, SlopeDistribution, by_angle, width};
use crate::spec::{Class, Laws, Parameter, Spec};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn SlopeDistribution> = Spec {
    class: Class {
        name: "Exponential_Angle_Distribution_Function",
        parent: "Angle_Distribution_Function",
        summary: "Exponential density of the tilt angle",
        equation: "S = 3 exp(-sqrt(6) theta/sigma)/(pi sigma^2 N (1+zeta^2)^2)",
        source: "torrance-1967",
        params: &[&[Parameter::number("sigma", 5.0, "deg", "Width in tilt angle")]],
        laws: Laws::NONE,
    },
    build: |node| {
        let sigma = width(node, "sigma")?.to_radians();
        let ExponentialConstants { norm, decay, quarter_turn } = ExponentialConstants::of(node);
        let reach = quarter_turn / sigma;
        // N (3).
        let integral = 1.0 - (-reach).exp() * (1.0 + reach);
        let peak = norm / (sigma * sigma * integral);
        Ok(Box::new(ExponentialAngle { peak, rate: decay / sigma }))
    },
};

struct ExponentialAngle {
    /// 3/(π σ² N), σ in radians.
    peak: f64,
    /// √6/σ.
    rate: f64,
}

impl SlopeDistribution for ExponentialAngle {
    fn density(&self, x: f64, y: f64) -> f64 {
        // (1), (2)
        by_angle(x, y, |theta_n| self.peak * (-self.rate * theta_n).exp())
    }
}
