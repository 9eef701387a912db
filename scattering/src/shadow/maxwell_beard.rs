//! Empirical shadowing and obscuration with two parameters.
//!
//! $$ G = \frac{1 + (\theta_n/\Omega)\,e^{-2\beta/\tau}}{1 + \theta_n/\Omega} $$
//!
//! θ_n is the tilt of the facet that connects the two directions, β the angle of incidence on it.
//! All angles are in radians, the parameters too.
//!
//! J. R. Maxwell et al., ERIM report AFAL-TR-73-303 (1973).

use super::Shadow;
use crate::{
    Direction, Incidence,
    spec::{Class, Laws, Parameter, ParameterError, ParameterNode, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn Shadow> = Spec {
    class: Class {
        name: "Maxwell_Beard_Shadow_Function",
        parent: "Shadow_Function",
        summary: "Empirical, two parameters",
        equation: "G = (1 + (tn/Omega) exp(-2 beta/tau))/(1 + tn/Omega)",
        source: "maxwell-1973",
        params: &[&[
            Parameter::number("Omega", 0.7, "rad", "Scale of the facet tilt"),
            Parameter::number("tau", 0.25, "rad", "Scale of the angle of incidence on the facet"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        Ok(Box::new(MaxwellBeard { omega: scale(node, "Omega")?, tau: scale(node, "tau")? }))
    },
};

fn scale(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let x = node.number(name);
    if x > 0.0 {
        return Ok(x);
    }
    Err(ParameterError::new(name, format!("{x} rad is not positive")))
}

struct MaxwellBeard {
    /// Ω, rad.
    omega: f64,
    /// τ, rad.
    tau: f64,
}

impl Shadow for MaxwellBeard {
    fn fraction(&self, incidence: &Incidence, direction: &Direction) -> f64 {
        let h = direction.k() - incidence.k();
        let theta_n = h.x.hypot(h.y).atan2(h.z);
        // |h| = 2 cos β.
        let beta = (0.5 * h.length()).min(1.0).acos();
        let ratio = theta_n / self.omega;
        (1.0 + ratio * (-2.0 * beta / self.tau).exp()) / (1.0 + ratio)
    }
}
