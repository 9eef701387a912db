//! Shadowing of a Gaussian random surface, averaged over facet slopes.
//!
//! $$ G = g(\theta_i)\,g(\theta_s), \qquad
//!    g = \frac{1-\tfrac12\,\mathrm{erfc}(\mu/\sqrt2 w)}{1+\Lambda}, \qquad
//!    \mu = \cot|\theta| $$
//!
//! $$ \Lambda = \tfrac12\left[\sqrt{2/\pi}\,\frac{w}{\mu}\,e^{-\mu^2/2w^2}
//!    - \mathrm{erfc}(\mu/\sqrt2 w)\right] $$
//!
//! w is the rms slope along one axis; for a Gaussian density of slopes w = s/√2 belongs to it.
//! The numerator averages over unknown slopes although the slope of the facet is known; the
//! Sancer function does without.
//!
//! B. G. Smith, IEEE Trans. Antennas Propag. AP-15, 668 (1967).

use std::f64::consts::FRAC_1_SQRT_2;

use super::{Shadow, sancer::lambda};
use crate::{
    Direction, Incidence,
    spec::{Class, Laws, Param, ParamError, Spec},
};

/// How programs name, parameterize and build it.
pub const SPEC: Spec<dyn Shadow> = Spec {
    class: Class {
        name: "Smith_Shadow_Function",
        parent: "Shadow_Function",
        summary: "Gaussian surface, averaged over facet slopes",
        equation: "G = g(ti) g(ts), g = (1 - erfc(mu/(sqrt(2) w))/2)/(1 + Lambda), mu = cot theta",
        source: "smith-1967",
        params: &[&[Param::number("w", "0.35", "1", "Rms slope along one axis")]],
        laws: Laws::NONE,
    },
    build: |node| {
        let w = node.number("w");
        if !(w > 0.0 && w.is_finite()) {
            return Err(ParamError::new("w", format!("{w} is not positive")));
        }
        Ok(Box::new(Smith { w }))
    },
};

struct Smith {
    w: f64,
}

impl Smith {
    fn one_ray(&self, sin: f64, cos: f64) -> f64 {
        let x = cos / sin.abs() * FRAC_1_SQRT_2 / self.w;
        (1.0 - 0.5 * libm::erfc(x)) / (1.0 + lambda(x))
    }
}

impl Shadow for Smith {
    fn fraction(&self, incidence: &Incidence, direction: &Direction) -> f64 {
        self.one_ray(incidence.sin, incidence.cos) * self.one_ray(direction.sin, direction.cos)
    }
}
