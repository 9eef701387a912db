//! No particles: a medium that neither scatters nor absorbs.

use super::PolarizedPhase;
use crate::{
    Mueller,
    spec::{Class, Laws, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn PolarizedPhase> = Spec {
    class: Class {
        name: "No_Polarized_Phase_Function",
        parent: "Polarized_Phase_Function",
        summary: "No particles",
        equation: "kappa_s = kappa_a = 0",
        source: "chandrasekhar-1960",
        params: &[],
        laws: Laws::NONE,
    },
    build: |_| Ok(Box::new(NoParticles)),
};

/// A medium without particles.
struct NoParticles;

impl PolarizedPhase for NoParticles {
    fn at_cosine(&self, _: f64) -> Mueller {
        Mueller::depolarizer(0.25 * std::f64::consts::FRAC_1_PI)
    }

    fn absorption(&self) -> f64 {
        0.0
    }

    fn scattering(&self) -> f64 {
        0.0
    }
}
