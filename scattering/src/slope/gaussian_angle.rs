//! Gaussian density of the tilt angle.
//!
//! $$ S = \frac{P(\theta_n)}{(1+\zeta^2)^2}, \quad \theta_n = \arctan\zeta \qquad (1) $$
//!
//! $$ P = \frac{e^{-\theta_n^2/\sigma^2}}{\pi\sigma^2 N}, \quad
//!    N = 1 - e^{-(\pi/2\sigma)^2} \qquad (2) $$
//!
//! σ is given in degrees. ∫2πθ P dθ = 1 from 0 to π/2, so ∫∫S is a little below 1 for wide σ.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

use super::{SlopeDistribution, by_angle, width};
use crate::spec::{Class, Laws, Parameter, Spec};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn SlopeDistribution> = Spec {
    class: Class {
        name: "Gaussian_Angle_Distribution_Function",
        parent: "Angle_Distribution_Function",
        summary: "Gaussian density of the tilt angle",
        equation: "S = exp(-theta^2/sigma^2)/(pi sigma^2 N (1+zeta^2)^2)",
        source: "torrance-1967",
        params: &[&[Parameter::number("sigma", 5.0, "deg", "Width in tilt angle")]],
        laws: Laws::NONE,
    },
    build: |node| {
        let sigma = width(node, "sigma")?.to_radians();
        let inverse = 1.0 / (sigma * sigma);
        // N (2).
        let integral = 1.0 - (-FRAC_PI_2 * FRAC_PI_2 * inverse).exp();
        Ok(Box::new(GaussianAngle { peak: FRAC_1_PI * inverse / integral, inverse }))
    },
};

struct GaussianAngle {
    /// 1/(π σ² N).
    peak: f64,
    /// 1/σ², σ in radians.
    inverse: f64,
}

impl SlopeDistribution for GaussianAngle {
    fn density(&self, x: f64, y: f64) -> f64 {
        // (1), (2)
        by_angle(x, y, |theta_n| self.peak * (-theta_n * theta_n * self.inverse).exp())
    }
}
