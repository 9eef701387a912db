//! Particles on a surface of given cleanliness, after IEST-STD-CC1246E.
//!
//! The number of particles larger than d µm on 0.1 m² is log₁₀ N = s(log₁₀² c − log₁₀² d), so
//!
//! $$ n(d) = \frac{2\,\lg e}{10^{11}} \exp\left[s\,\lg e\,(\ln^2 c - \ln^2 d)\right]
//!    \frac{s \ln d}{d}\,\frac{C(0.926)}{C(s)}, \qquad d \ge 1 $$
//!
//! per µm² and µm. c is the cleanliness level (µm), s the slope, and C(s) = ∫₁¹⁰⁰⁰ (π/4)d² n dd
//! without the last factor: another slope than the standard's 0.926 redistributes the sizes over
//! the same covered area. `--compat` uses lg e and 2 lg e with six digits.

use std::f64::consts::{FRAC_PI_4, LOG10_E};

use super::SurfaceSize;
use crate::{
    Defect,
    spec::{Class, Laws, Parameter, ParameterError, Spec},
    special::gauss,
};

/// The slope of the standard.
const STANDARD_SLOPE: f64 = 0.926;
/// 0.1 m² in µm².
const AREA: f64 = 1e11;

/// Name, parameters and constructor of a [`Cleanliness`] distribution.
pub const SPEC: Spec<dyn SurfaceSize> = Spec {
    class: Class {
        name: "CC1246E_SurfaceParticleSizeDistribution",
        parent: "SurfaceParticleSizeDistribution",
        summary: "Particles on a surface of given cleanliness (IEST-STD-CC1246E)",
        equation: "n = 2 lg(e)/1e11 exp(s lg(e) (ln(c)^2-ln(d)^2)) s ln(d)/d C(0.926)/C(s), d >= 1",
        source: "iest-cc1246e-2013",
        params: &[&[
            Parameter::number("cleanliness", 1000.0, "um", "Cleanliness level c"),
            Parameter::number("slope", 0.926, "1", "Slope s of the distribution"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        let (level, slope) = (node.number("cleanliness"), node.number("slope"));
        for (name, value) in [("cleanliness", level), ("slope", slope)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(ParameterError::new(name, format!("{value} is not positive")));
            }
        }
        let compat = node.reproduces(Defect::CleanlinessDigits);
        let (lg_e, norm) =
            if compat { (0.434294, 8.68589e-12) } else { (LOG10_E, 2.0 * LOG10_E / AREA) };
        let at = |slope| Cleanliness { ln_level: level.ln(), slope, lg_e, norm };
        let norm = norm * at(STANDARD_SLOPE).covered_area() / at(slope).covered_area();
        Ok(Box::new(Cleanliness { norm, ..at(slope) }))
    },
};

/// A distribution of particles on a surface of given cleanliness.
#[derive(Clone, Copy, Debug)]
pub struct Cleanliness {
    ln_level: f64,
    slope: f64,
    lg_e: f64,
    norm: f64,
}

impl Cleanliness {
    /// The fraction of the area that the particles from 1 µm to 1 mm cover.
    fn covered_area(&self) -> f64 {
        gauss::integrate(64, 0.0, 1000f64.ln(), |u| {
            let d = u.exp();
            d * FRAC_PI_4 * d * d * self.density(d)
        })
    }
}

impl SurfaceSize for Cleanliness {
    fn density(&self, d: f64) -> f64 {
        if d < 1.0 {
            return 0.0;
        }
        let u = d.ln();
        let exponent = self.slope * self.lg_e * (self.ln_level * self.ln_level - u * u);
        self.norm * exponent.exp() * self.slope * u / d
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Mode, ParameterNode, ParameterValue, spec};

    fn build(mode: Mode, slope: f64) -> Box<dyn SurfaceSize> {
        let node = ParameterNode::with_defaults(&SPEC.class, mode)
            .with("slope", ParameterValue::Number(slope))
            .unwrap();
        spec::build::<dyn SurfaceSize>(&node).unwrap()
    }

    #[test]
    fn the_number_above_a_diameter_is_that_of_the_standard() {
        let n = build(Mode::Sound, STANDARD_SLOPE);
        // ∫ from 100 µm to where log N has fallen by 24 decades.
        let above =
            gauss::integrate(400, 100f64.ln(), 1e6f64.ln(), |u| u.exp() * n.density(u.exp()));
        let expected = 10f64.powf(STANDARD_SLOPE * (9.0 - 4.0)) / AREA;
        assert!((above / expected - 1.0).abs() < 1e-10);
    }

    #[test]
    fn another_slope_keeps_the_covered_area() {
        let area = |slope| {
            let n = build(Mode::Sound, slope);
            gauss::integrate(200, 0.0, 1000f64.ln(), |u| (3.0 * u).exp() * n.density(u.exp()))
        };
        assert!((area(0.4) / area(STANDARD_SLOPE) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn six_digits_differ_by_less_than_a_tenth_of_a_thousandth() {
        let ratio =
            build(Mode::Compat, 0.926).density(50.0) / build(Mode::Sound, 0.926).density(50.0);
        assert!(ratio != 1.0 && (ratio - 1.0).abs() < 1e-4);
    }
}
