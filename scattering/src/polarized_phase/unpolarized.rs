//! Phase matrix that depolarizes completely: P = p(θ) diag(1, 0, 0, 0).

use super::{PolarizedPhase, SCALAR, ScalarPhase};
use crate::{
    Mueller,
    spec::{Class, Laws, Spec},
};

/// Name, parameters and constructor of an [`Unpolarized`] phase matrix.
pub const SPEC: Spec<dyn PolarizedPhase> = Spec {
    class: Class {
        name: "Unpolarized_Phase_Function",
        parent: "Polarized_Phase_Function",
        summary: "Complete depolarization",
        equation: "P = p diag(1,0,0,0)",
        source: "chandrasekhar-1960",
        params: &[SCALAR],
        laws: Laws::NONE,
    },
    build: |node| Ok(Box::new(Unpolarized(ScalarPhase::read(node)?))),
};

/// A phase matrix that depolarizes completely.
struct Unpolarized(ScalarPhase);

impl PolarizedPhase for Unpolarized {
    fn at_cosine(&self, cos: f64) -> Mueller {
        Mueller::depolarizer(self.0.phase.at_cosine(cos))
    }

    fn absorption(&self) -> f64 {
        self.0.absorption
    }

    fn scattering(&self) -> f64 {
        self.0.scattering
    }
}
