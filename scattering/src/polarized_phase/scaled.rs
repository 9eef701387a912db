//! A phase matrix with coefficients of its own: those of the particles are replaced.

use super::{FAMILY, PolarizedPhase, coefficient};
use crate::{
    Mueller,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of the class.
pub const SPEC: Spec<dyn PolarizedPhase> = Spec {
    class: Class {
        name: "Scaled_Phase_Function",
        parent: "Polarized_Phase_Function",
        summary: "Phase matrix of other particles with given coefficients",
        equation: "P = P_phase, kappa_s = scattering, kappa_a = absorption",
        source: "hovenier-2004",
        params: &[&[
            Parameter::member(
                "phase",
                &FAMILY,
                "SphericalScatterer_Phase_Function",
                "The phase matrix",
            ),
            Parameter::number("scattering", 0.1, "1/um", "Scattering coefficient"),
            Parameter::number("absorption", 0.0, "1/um", "Absorption coefficient"),
        ]],
        laws: Laws::NONE,
    },
    build: |node| {
        Ok(Box::new(ScaledPhase {
            phase: node.member::<dyn PolarizedPhase>("phase")?,
            absorption: coefficient(node, "absorption")?,
            scattering: coefficient(node, "scattering")?,
        }))
    },
};

/// A phase matrix with given coefficients.
struct ScaledPhase {
    phase: Box<dyn PolarizedPhase>,
    absorption: f64,
    scattering: f64,
}

impl PolarizedPhase for ScaledPhase {
    fn at_cosine(&self, cos: f64) -> Mueller {
        self.phase.at_cosine(cos)
    }

    fn absorption(&self) -> f64 {
        self.absorption
    }

    fn scattering(&self) -> f64 {
        self.scattering
    }
}
