//! Elliptic Gaussian density of slopes.
//!
//! $$ S = \frac{1}{2\pi\sigma_x\sigma_y}
//!    \exp\left(-\tfrac12\left(\frac{\zeta_x^2}{\sigma_x^2}
//!    + \frac{\zeta_y^2}{\sigma_y^2}\right)\right) $$
//!
//! σ_x and σ_y (`sigmax`, `sigmay`) are the standard deviations of the slopes along the axes of
//! the sample. With σ_x = σ_y = σ it is the isotropic Gaussian with s² = 2σ².
//!
//! `printed` = 1 takes the density as the paper prints it, exp(−√(ζ_x²/σ_x² + ζ_y²/σ_y²)): that is
//! the elliptic exponential, `Anisotropic_Exponential_Slope_Distribution_Function` with
//! sx = √6 σ_x, whose standard deviations are √3 σ.
//!
//! C. Cox and W. Munk, J. Opt. Soc. Am. 44, 838 (1954).

use std::f64::consts::TAU;

use super::{ClosedForm, DensityKernel, SlopeDistribution, width};
use crate::{
    lanes::{Real, WIDTH, dispatch},
    spec::{Class, Laws, Parameter, ParameterError, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn SlopeDistribution> = Spec {
    class: Class {
        name: "Anisotropic_Gaussian_Slope_Distribution_Function",
        parent: "Slope_Distribution_Function",
        summary: "Elliptic Gaussian density of slopes",
        equation: "S = 1/(2 pi sigmax sigmay) exp(-(zeta_x^2/sigmax^2 + zeta_y^2/sigmay^2)/2)",
        source: "cox-1954",
        params: &[&[
            Parameter::number("sigmax", 0.1, "1", "Standard deviation of the slope along x"),
            Parameter::number("sigmay", 0.1, "1", "Standard deviation of the slope along y"),
            Parameter::integer("printed", 0, "1: the exponential that the paper prints for it"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let (x, y) = (width(node, "sigmax")?, width(node, "sigmay")?);
        let printed = match node.integer("printed") {
            0 => false,
            1 => true,
            other => return Err(ParameterError::new("printed", format!("{other} is not 0 or 1"))),
        };
        let wider = if printed { 3f64.sqrt() } else { 1.0 };
        Ok(Box::new(AnisotropicGaussian {
            deviations: (wider * x, wider * y),
            peak: 1.0 / (TAU * x * y),
            half_inverse: (0.5 / (x * x), 0.5 / (y * y)),
            printed,
        }))
    },
};

struct AnisotropicGaussian {
    deviations: (f64, f64),
    /// 1/(2π σ_x σ_y).
    peak: f64,
    /// 1/(2σ²) along x and y.
    half_inverse: (f64, f64),
    /// True for the exponential that the paper prints.
    printed: bool,
}

impl ClosedForm for AnisotropicGaussian {
    #[inline(always)]
    fn at<R: Real>(&self, x: R, y: R) -> R {
        let (half_inverse_x, half_inverse_y) = self.half_inverse;
        let half = x * x * half_inverse_x + y * y * half_inverse_y;
        let exponent = if self.printed { (half * 2.0).sqrt() } else { half };
        (-exponent).exp_falling() * self.peak
    }
}

impl SlopeDistribution for AnisotropicGaussian {
    fn density(&self, x: f64, y: f64) -> f64 {
        self.at(x, y)
    }

    fn densities(&self, zeta: &[[[f64; WIDTH]; 2]], out: &mut [[f64; WIDTH]]) {
        dispatch(DensityKernel { form: self, zeta, out });
    }

    fn deviations(&self) -> Option<(f64, f64)> {
        Some(self.deviations)
    }
}
