//! Isotropic Gaussian density of slopes.
//!
//! $$ S = \frac{1}{\pi s^2}\,e^{-\zeta^2/s^2}, \qquad \zeta^2 = \zeta_x^2+\zeta_y^2 $$
//!
//! s is the total rms slope: ⟨ζ_x²⟩ = ⟨ζ_y²⟩ = s²/2.
//!
//! K. E. Torrance and E. M. Sparrow, J. Opt. Soc. Am. 57, 1105 (1967), for facets with a density
//! of slopes.

use std::f64::consts::{FRAC_1_PI, FRAC_1_SQRT_2};

use super::{ClosedForm, DensityKernel, SlopeDistribution, width};
use crate::{
    lanes::{Real, WIDTH, dispatch},
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn SlopeDistribution> = Spec {
    class: Class {
        name: "Gaussian_Slope_Distribution_Function",
        parent: "Slope_Distribution_Function",
        summary: "Isotropic Gaussian density of slopes",
        equation: "S = 1/(pi s^2) exp(-zeta^2/s^2)",
        source: "torrance-1967",
        params: &[&[Parameter::number("s", 0.1, "1", "Total rms slope")]],
        laws: Laws::NONE,
    },
    build: |node| {
        let s = width(node, "s")?;
        let inverse = 1.0 / (s * s);
        Ok(Box::new(GaussianSlope { s, peak: FRAC_1_PI * inverse, inverse }))
    },
};

struct GaussianSlope {
    s: f64,
    /// 1/(π s²).
    peak: f64,
    /// 1/s².
    inverse: f64,
}

impl ClosedForm for GaussianSlope {
    #[inline(always)]
    fn at<R: Real>(&self, x: R, y: R) -> R {
        (-(x * x + y * y) * self.inverse).exp_falling() * self.peak
    }
}

impl SlopeDistribution for GaussianSlope {
    fn density(&self, x: f64, y: f64) -> f64 {
        self.at(x, y)
    }

    fn densities(&self, zeta: &[[[f64; WIDTH]; 2]], out: &mut [[f64; WIDTH]]) {
        dispatch(DensityKernel { form: self, zeta, out });
    }

    fn deviations(&self) -> Option<(f64, f64)> {
        Some((self.s * FRAC_1_SQRT_2, self.s * FRAC_1_SQRT_2))
    }
}
