//! Elliptic exponential density of slopes.
//!
//! $$ S = \frac{3}{\pi s_x s_y}\,
//!    \exp\left(-\sqrt{6\,(\zeta_x^2/s_x^2 + \zeta_y^2/s_y^2)}\right) $$
//!
//! ⟨ζ_x²⟩ = s_x²/2: s_x and s_y are √2 times the rms slopes along the axes of the sample. The
//! printed form of the "Gaussian" of pigmented coatings, exp(−√(ζ_x²/σ_x² + ζ_y²/σ_y²))/(2πσ_xσ_y),
//! is this density with s = √6 σ. NIST's library uses 3/π and √6 with twelve digits
//! ([`Defect::SlopeConstants`](crate::Defect::SlopeConstants)).
//!
//! K. E. Torrance and E. M. Sparrow, J. Opt. Soc. Am. 57, 1105 (1967), for facets with a density
//! of slopes.

use std::f64::consts::FRAC_1_SQRT_2;

use super::{ExponentialConstants, SlopeDistribution, width};
use crate::spec::{Class, Laws, Parameter, Spec};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn SlopeDistribution> = Spec {
    class: Class {
        name: "Anisotropic_Exponential_Slope_Distribution_Function",
        parent: "Slope_Distribution_Function",
        summary: "Elliptic exponential density of slopes",
        equation: "S = 3/(pi sx sy) exp(-sqrt(6 (zeta_x^2/sx^2 + zeta_y^2/sy^2)))",
        source: "torrance-1967",
        params: &[&[
            Parameter::number("sx", 0.1, "1", "sqrt(2) times the rms slope along x"),
            Parameter::number("sy", 0.01, "1", "sqrt(2) times the rms slope along y"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let (sx, sy) = (width(node, "sx")?, width(node, "sy")?);
        let ExponentialConstants { norm, decay, .. } = ExponentialConstants::of(node);
        Ok(Box::new(AnisotropicExponential { sx, sy, peak: norm / (sx * sy), decay }))
    },
};

struct AnisotropicExponential {
    sx: f64,
    sy: f64,
    /// 3/(π s_x s_y).
    peak: f64,
    /// √6.
    decay: f64,
}

impl SlopeDistribution for AnisotropicExponential {
    fn density(&self, x: f64, y: f64) -> f64 {
        let (u, v) = (x / self.sx, y / self.sy);
        self.peak * (-self.decay * (u * u + v * v).sqrt()).exp()
    }

    fn deviations(&self) -> Option<(f64, f64)> {
        Some((self.sx * FRAC_1_SQRT_2, self.sy * FRAC_1_SQRT_2))
    }
}
