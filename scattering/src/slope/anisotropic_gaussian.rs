//! Elliptic Gaussian density of slopes.
//!
//! $$ S = \frac{1}{2\pi\sigma_x\sigma_y}
//!    \exp\left(-\tfrac12\left(\frac{\zeta_x^2}{\sigma_x^2}
//!    + \frac{\zeta_y^2}{\sigma_y^2}\right)\right) $$
//!
//! σ_x and σ_y (`sigmax`, `sigmay`) are the standard deviations of the slopes along the axes of
//! the sample. With σ_x = σ_y = σ it is the isotropic Gaussian with s² = 2σ².
//!
//! C. Cox and W. Munk, J. Opt. Soc. Am. 44, 838 (1954).

use std::f64::consts::TAU;

use super::{SlopeDistribution, width};
use crate::spec::{Class, Laws, Param, Spec};

/// How programs name, parameterize and build it.
pub const SPEC: Spec<dyn SlopeDistribution> = Spec {
    class: Class {
        name: "Anisotropic_Gaussian_Slope_Distribution_Function",
        parent: "Slope_Distribution_Function",
        summary: "Elliptic Gaussian density of slopes",
        equation: "S = 1/(2 pi sigmax sigmay) exp(-(zeta_x^2/sigmax^2 + zeta_y^2/sigmay^2)/2)",
        source: "cox-1954",
        params: &[&[
            Param::number("sigmax", "0.1", "1", "Standard deviation of the slope along x"),
            Param::number("sigmay", "0.1", "1", "Standard deviation of the slope along y"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let (x, y) = (width(node, "sigmax")?, width(node, "sigmay")?);
        Ok(Box::new(AnisotropicGaussian {
            deviations: (x, y),
            peak: 1.0 / (TAU * x * y),
            half_inverse: (0.5 / (x * x), 0.5 / (y * y)),
        }))
    },
};

struct AnisotropicGaussian {
    deviations: (f64, f64),
    peak: f64,
    /// 1/(2σ²) along x and y.
    half_inverse: (f64, f64),
}

impl SlopeDistribution for AnisotropicGaussian {
    fn density(&self, x: f64, y: f64) -> f64 {
        let (a, b) = self.half_inverse;
        self.peak * (-(x * x * a + y * y * b)).exp()
    }

    fn deviations(&self) -> Option<(f64, f64)> {
        Some(self.deviations)
    }
}
