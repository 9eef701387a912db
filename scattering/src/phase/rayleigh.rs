//! Scalar Rayleigh scattering: p = 3(1 + cos²θ)/16π.
//!
//! S. Chandrasekhar, *Radiative Transfer* (Dover, 1960), §3.

use std::f64::consts::FRAC_1_PI;

use super::Phase;
use crate::{
    Defect,
    spec::{Class, Laws, Spec},
};

/// Name and constructor of a [`RayleighPhase`] phase function.
pub const SPEC: Spec<dyn Phase> = Spec {
    class: Class {
        name: "Rayleigh_Phase_Function",
        parent: "Phase_Function",
        summary: "Unpolarized light scattered by particles much smaller than the wavelength",
        equation: "p = 3 (1+cos(theta)^2)/(16 pi)",
        source: "chandrasekhar-1960",
        params: &[],
        laws: Laws::NONE,
    },
    build: |node| {
        let compat = node.reproduces(Defect::PhaseNorm);
        Ok(Box::new(RayleighPhase { norm: 0.75 * if compat { 1.0 } else { 0.25 * FRAC_1_PI } }))
    },
};

/// Scalar Rayleigh scattering.
#[derive(Clone, Copy, Debug)]
pub struct RayleighPhase {
    norm: f64,
}

impl Phase for RayleighPhase {
    fn at_cosine(&self, cos: f64) -> f64 {
        self.norm * (1.0 + cos * cos)
    }
}
