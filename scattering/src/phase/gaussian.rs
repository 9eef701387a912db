//! Gaussian of the scattering angle on an isotropic background.
//!
//! $$ p = \frac{(1-b)\,e^{-\theta^2/2w^2} + b}{2\pi N} \qquad (1) $$
//!
//! $$ N = 2b + (1-b)\int_0^\pi e^{-\theta^2/2w^2}\sin\theta\,d\theta \qquad (2) $$
//!
//! w is the width (given in degrees), b the background; with N the integral over all directions is
//! 1. `--compat` takes the integral in N from a series for small w.

use std::f64::consts::PI;

use super::Phase;
use crate::{
    Defect,
    spec::{Class, Laws, Parameter, ParameterError, Spec},
    special::gauss,
};

/// Name, parameters and constructor of a [`GaussianPhase`] phase function.
pub const SPEC: Spec<dyn Phase> = Spec {
    class: Class {
        name: "Gaussian_Phase_Function",
        parent: "Phase_Function",
        summary: "Gaussian of the scattering angle on a background",
        equation: "p = ((1-b) exp(-theta^2/(2w^2)) + b)/(2 pi N)",
        source: "chandrasekhar-1960",
        params: &[&[
            Parameter::number(
                "width",
                20.0,
                "deg",
                "Width of the Gaussian, its standard deviation",
            ),
            Parameter::number("background", 0.1, "1", "Height of the background against the peak"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let width = node.number("width").to_radians().abs();
        if !(width > 0.0 && width.is_finite()) {
            return Err(ParameterError::new("width", "a width has to be positive"));
        }
        let b = node.number("background");
        let compat = node.reproduces(Defect::GaussianPhaseSeries);
        let lobe = if compat { series(width) } else { solid_angle(width) };
        // 1/2πN (2).
        let norm = 1.0 / (2.0 * PI * (2.0 * b + (1.0 - b) * lobe));
        let falloff = -0.5 / (width * width);
        Ok(Box::new(GaussianPhase { peak: (1.0 - b) * norm, background: b * norm, falloff }))
    },
};

/// A Gaussian lobe on a background.
#[derive(Clone, Copy, Debug)]
pub struct GaussianPhase {
    /// (1 − b)/2πN.
    peak: f64,
    /// b/2πN.
    background: f64,
    /// −1/2w², w in radians.
    falloff: f64,
}

impl Phase for GaussianPhase {
    fn at_cosine(&self, cos: f64) -> f64 {
        let theta = cos.clamp(-1.0, 1.0).acos();
        // (1)
        self.peak * (self.falloff * theta * theta).exp() + self.background
    }
}

/// ∫ exp(−θ²/2w²) sin θ dθ from 0 to π.
fn solid_angle(w: f64) -> f64 {
    // exp(−9²/2) = 3e-18 of the peak is left out.
    let end = (9.0 * w).min(PI);
    gauss::integrate(40, 0.0, end, |t| (-0.5 * (t / w).powi(2)).exp() * t.sin())
}

/// The same by powers of w, as if θ ran to infinity.
fn series(w: f64) -> f64 {
    let w2 = w * w;
    w2 - w2 * w2 / 3.0 + w2 * w2 * w2 / 15.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_is_the_norm_of_narrow_lobes() {
        // The next term is −w⁸/105.
        assert!((series(0.05) - solid_angle(0.05)).abs() < 1e-12);
        assert!((series(1.0) - solid_angle(1.0)).abs() > 1e-3);
    }
}
