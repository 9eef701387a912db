//! Shadowing of an anisotropic Gaussian surface for a known facet slope.
//!
//! $$ G = \frac{1}{1+\Lambda_i+\Lambda_s} \qquad (1) $$
//!
//! $$ \Lambda = \tfrac12\left[\frac{e^{-x^2}}{\sqrt\pi\,x} - \mathrm{erfc}\,x\right], \quad
//!    x = \frac{\cot|\theta|}{\sqrt2\,\sigma}, \quad
//!    \sigma^2 = \sigma_x^2 \cos^2\alpha + \sigma_y^2 \sin^2\alpha \qquad (2) $$
//!
//! σ is the standard deviation of the slope along the azimuth α of a ray in the sample. 1 + Λ is
//! the projected area of all facets that face a ray over the area of the plane, so that 1/(1 + Λ_i)
//! alone conserves energy exactly.
//!
//! Two rays in one half plane (α_i = α_s, as in retro-reflection) are shadowed by the same
//! neighbours: then only the larger Λ counts,
//!
//! $$ G = \frac{1}{1 + \max\Lambda + t\,\min\Lambda} \qquad (3) $$
//!
//! and `azimuth` chooses t:
//! 0, as printed: t = 0 where |Δα| ≤ 10⁻¹⁰ and 1 elsewhere, a jump;
//! 1: t = 1, which is (1), everywhere;
//! 2: t = 4.41Δα/(4.41Δα + 1), which is smooth: use it for pictures.
//!
//! `sigmax` or `sigmay` = 0 takes the deviation from the slope distribution of the facets.
//! With other slopes than Gaussian ones the hemispherical reflectance can exceed 1.
//!
//! M. I. Sancer, IEEE Trans. Antennas Propag. AP-17, 577 (1969); the smooth variant
//! B. van Ginneken et al., Appl. Opt. 37, 130 (1998).

use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

use super::Shadow;
use crate::{
    Direction, Incidence,
    slope::SlopeDistribution,
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
    special::erf::{ROOT_PI, falling_and_scaled},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Shadow> = Spec {
    class: Class {
        name: "Sancer_Shadow_Function",
        parent: "Shadow_Function",
        summary: "Anisotropic Gaussian surface, facet slope known",
        equation: "G = 1/(1 + Lambda_i + Lambda_s)",
        source: "sancer-1969 van-ginneken-1998",
        params: &[&[
            Parameter::number(
                "sigmax",
                0.0,
                "1",
                "Standard deviation of the slope along x; 0: that of sdf",
            ),
            Parameter::number(
                "sigmay",
                0.0,
                "1",
                "Standard deviation of the slope along y; 0: that of sdf",
            ),
            Parameter::integer("azimuth", 0, "Equal azimuths: 0 a jump, 1 ignored, 2 smooth"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        Ok(Box::new(Sancer {
            sigma_x: deviation(node, "sigmax")?,
            sigma_y: deviation(node, "sigmay")?,
            azimuths: Azimuths::read(node)?,
        }))
    },
};

/// Behaviour if both rays have the same azimuth.
#[derive(Clone, Copy)]
enum Azimuths {
    Jump,
    General,
    Smooth,
}

impl Azimuths {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        match node.integer("azimuth") {
            0 => Ok(Self::Jump),
            1 => Ok(Self::General),
            2 => Ok(Self::Smooth),
            other => Err(ParameterError::new("azimuth", format!("{other} is not 0, 1 or 2"))),
        }
    }
}

fn deviation(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let sigma = node.number(name);
    if sigma >= 0.0 && sigma.is_finite() {
        return Ok(sigma);
    }
    Err(ParameterError::new(name, format!("{sigma} is negative or not finite")))
}

struct Sancer {
    sigma_x: f64,
    sigma_y: f64,
    azimuths: Azimuths,
}

/// Azimuths closer than this count as equal in the printed form.
const SAME_AZIMUTH: f64 = 1e-10;

impl Sancer {
    /// Λ of a ray by the sine and cosine of its polar angle and the cosine and sine of α. (2)
    fn of_ray(&self, sin: f64, cos: f64, cos_alpha: f64, sin_alpha: f64) -> f64 {
        let sigma = (self.sigma_x * cos_alpha).hypot(self.sigma_y * sin_alpha);
        let x = cos / sin.abs() * FRAC_1_SQRT_2 / sigma;
        lambda(x)
    }
}

impl Shadow for Sancer {
    fn fraction(&self, incidence: &Incidence, direction: &Direction) -> f64 {
        let (sin_r, cos_r) = (incidence.sin_rotation, incidence.cos_rotation);
        let (x, y) = (direction.cos_phi, direction.sin_phi);
        let lambda_i = self.of_ray(incidence.sin, incidence.cos, cos_r, sin_r);
        let lambda_s =
            self.of_ray(direction.sin, direction.cos, x * cos_r + y * sin_r, y * cos_r - x * sin_r);
        let (low, high) = (lambda_i.min(lambda_s), lambda_i.max(lambda_s));
        if low == 0.0 {
            return 1.0 / (1.0 + high);
        }
        let t = match self.azimuths {
            Azimuths::General => 1.0,
            Azimuths::Jump => f64::from(azimuth_between(incidence, direction) > SAME_AZIMUTH),
            Azimuths::Smooth => {
                let scaled = 4.41 * azimuth_between(incidence, direction);
                scaled / (scaled + 1.0)
            }
        };
        // (3)
        1.0 / (1.0 + high + t * low)
    }

    fn adapt(&mut self, slopes: &dyn SlopeDistribution) -> Result<(), ParameterError> {
        for (name, sigma, axis) in
            [("sigmax", &mut self.sigma_x, 0), ("sigmay", &mut self.sigma_y, 1)]
        {
            if *sigma != 0.0 {
                continue;
            }
            let (x, y) = slopes.deviations().ok_or_else(|| {
                ParameterError::new(name, "the slope distribution has no known deviation; give one")
            })?;
            *sigma = if axis == 0 { x } else { y };
        }
        Ok(())
    }
}

/// Angle from 0 to π between the azimuths of the source and of the exit ray.
fn azimuth_between(incidence: &Incidence, direction: &Direction) -> f64 {
    // The source stands at azimuth π; a negative polar angle is a positive one on the other side.
    let turned = if incidence.sin * direction.sin < 0.0 { 0.0 } else { PI };
    let delta = (direction.phi() - turned).abs() % TAU;
    delta.min(TAU - delta)
}

/// Λ = ½[e^{−x²}/(√π x) − erfc x], (2); beyond x = 26 it is below 10⁻²⁹⁵ and taken as 0.
pub fn lambda(x: f64) -> f64 {
    if x > 26.0 {
        return 0.0;
    }
    // erfc x = e^{−x²} scaled/(1 + 2x).
    let [falling, scaled] = falling_and_scaled(x);
    (falling / (x * ROOT_PI) - falling * scaled / (x * 2.0 + 1.0)) * 0.5
}
