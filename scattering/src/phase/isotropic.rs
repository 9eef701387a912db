//! The same density in all directions: p = 1/4π.

use std::f64::consts::FRAC_1_PI;

use super::Phase;
use crate::spec::{Class, Laws, Spec};

/// Name and constructor of an [`IsotropicPhase`] phase function.
pub const SPEC: Spec<dyn Phase> = Spec {
    class: Class {
        name: "Isotropic_Phase_Function",
        parent: "Phase_Function",
        summary: "The same in all directions",
        equation: "p = 1/(4 pi)",
        source: "chandrasekhar-1960",
        params: &[],
        laws: Laws::NONE,
    },
    build: |_| Ok(Box::new(IsotropicPhase)),
};

/// Isotropic scattering.
#[derive(Clone, Copy, Debug, Default)]
pub struct IsotropicPhase;

impl Phase for IsotropicPhase {
    fn at_cosine(&self, _: f64) -> f64 {
        0.25 * FRAC_1_PI
    }
}
