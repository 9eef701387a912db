//! Isotropic exponential density of slopes.
//!
//! $$ S = \frac{3}{\pi s^2}\,e^{-\sqrt{6}\,\zeta/s}, \qquad \zeta^2 = \zeta_x^2+\zeta_y^2 $$
//!
//! s is the total rms slope: ⟨ζ_x²⟩ = ⟨ζ_y²⟩ = s²/2. NIST's library uses 3/π and √6 with twelve
//! digits ([`Defect::SlopeConstants`](crate::Defect::SlopeConstants)).
//!
//! K. E. Torrance and E. M. Sparrow, J. Opt. Soc. Am. 57, 1105 (1967), for facets with a density
//! of slopes.

use std::f64::consts::FRAC_1_SQRT_2;

use super::{ExponentialConstants, SlopeDistribution, width};
use crate::spec::{Class, Laws, Parameter, Spec};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn SlopeDistribution> = Spec {
    class: Class {
        name: "Exponential_Slope_Distribution_Function",
        parent: "Slope_Distribution_Function",
        summary: "Isotropic exponential density of slopes",
        equation: "S = 3/(pi s^2) exp(-sqrt(6) zeta/s)",
        source: "torrance-1967",
        params: &[&[Parameter::number("s", 0.1, "1", "Total rms slope")]],
        laws: Laws::NONE,
    },
    build: |node| {
        let s = width(node, "s")?;
        let ExponentialConstants { norm, decay, .. } = ExponentialConstants::of(node);
        Ok(Box::new(ExponentialSlope { s, peak: norm / (s * s), rate: decay / s }))
    },
};

struct ExponentialSlope {
    s: f64,
    /// 3/(π s²).
    peak: f64,
    /// √6/s.
    rate: f64,
}

impl SlopeDistribution for ExponentialSlope {
    fn density(&self, x: f64, y: f64) -> f64 {
        let zeta = (x * x + y * y).sqrt();
        self.peak * (-self.rate * zeta).exp()
    }

    fn deviations(&self) -> Option<(f64, f64)> {
        Some((self.s * FRAC_1_SQRT_2, self.s * FRAC_1_SQRT_2))
    }
}
