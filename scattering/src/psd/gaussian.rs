//! Spectrum of a surface with a Gaussian correlation of heights.
//!
//! $$ \mathrm{PSD} = \pi (\sigma \ell)^2 \exp[-(\pi \ell f)^2] $$
//!
//! σ is the rms height, ℓ the distance at which the correlation has fallen to 1/e.
//!
//! J. M. Elson and J. M. Bennett, *Relation between the angular dependence of scattering and the
//! statistical properties of optical surfaces*, J. Opt. Soc. Am. 69, 31 (1979).

use std::f64::consts::PI;

use crate::{
    psd::Psd,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of a [`GaussianPsd`].
pub const SPEC: Spec<dyn Psd> = Spec {
    class: Class {
        name: "Gaussian_PSD_Function",
        parent: "PSD_Function",
        summary: "Gaussian correlation of heights",
        equation: "PSD = pi (sigma length)^2 exp(-(pi length f)^2)",
        source: "elson-1979",
        params: &[&[
            Parameter::number("sigma", 0.05, "um", "Rms height"),
            Parameter::number("length", 5.0, "um", "Correlation length"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let (sigma, length) = (node.number("sigma"), node.number("length"));
        Ok(Box::new(GaussianPsd {
            peak: PI * (sigma * length).powi(2),
            fall: (PI * length).powi(2),
        }))
    },
};

/// A Gaussian spectrum.
#[derive(Clone, Debug)]
pub struct GaussianPsd {
    /// π(σℓ)², µm⁴.
    peak: f64,
    /// (πℓ)², µm².
    fall: f64,
}

impl Psd for GaussianPsd {
    fn density(&self, fx: f64, fy: f64) -> f64 {
        let f2 = fx * fx + fy * fy;
        self.peak * (-self.fall * f2).exp()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use crate::{Mode, psd::tests::build};

    #[test]
    fn integral_over_all_frequencies_is_the_mean_square_height() {
        let (sigma, length) = (0.03, 2.0);
        let numbers = [("sigma", sigma), ("length", length)];
        let psd = build("Gaussian_PSD_Function", Mode::Sound, &numbers);
        // The midpoint rule converges as fast as the integrand is smooth: here to rounding.
        let (step, n) = (0.002, 2000);
        let sum: f64 = (0..n)
            .map(|j| (f64::from(j) + 0.5) * step)
            .map(|f| TAU * f * psd.density(f, 0.0) * step)
            .sum();
        assert!((sum / (sigma * sigma) - 1.0).abs() < 1e-4);
    }
}
