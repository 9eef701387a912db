//! The family of polarized phase functions: its interface, and what its classes share.

use crate::{
    Mueller, ParameterNode,
    phase::{self, Phase},
    spec::{self, Family, Parameter, ParameterError},
};

/// The family of polarized phase functions.
pub static FAMILY: Family = Family::new(
    "Polarized_Phase_Function",
    "Polarized phase functions",
    spec::classes::<dyn PolarizedPhase>,
);

/// A phase matrix with the coefficients of the medium that scatters.
pub trait PolarizedPhase: Send + Sync {
    /// Phase matrix (1/sr) at the cosine of the scattering angle, in the (∥, ⊥) basis of the
    /// scattering plane: Q = I_∥ − I_⊥; ∫ P00 dΩ = 1 where its scalar phase function has it.
    fn at_cosine(&self, cos: f64) -> Mueller;

    /// Absorption coefficient, 1/µm.
    fn absorption(&self) -> f64;

    /// Scattering coefficient, 1/µm.
    fn scattering(&self) -> f64;
}

/// The parameters of phase matrices that multiply a scalar phase function.
pub const SCALAR: &[Parameter] = &[
    Parameter::member(
        "phase_function",
        &phase::FAMILY,
        "Henyey_Greenstein_Phase_Function",
        "Scalar phase function",
    ),
    Parameter::number(
        "log_absorption",
        -20.0,
        "ln(1/um)",
        "Natural logarithm of the absorption coefficient",
    ),
    Parameter::number(
        "log_scattering",
        0.0,
        "ln(1/um)",
        "Natural logarithm of the scattering coefficient",
    ),
];

/// A scalar phase function with the coefficients that stand beside it.
pub(super) struct ScalarPhase {
    pub(super) phase: Box<dyn Phase>,
    pub(super) absorption: f64,
    pub(super) scattering: f64,
}

impl ScalarPhase {
    pub(super) fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        Ok(Self {
            phase: node.member::<dyn Phase>("phase_function")?,
            absorption: exponential(node, "log_absorption")?,
            scattering: exponential(node, "log_scattering")?,
        })
    }
}

/// The coefficient `name`, 1/µm, which must not be negative.
pub(super) fn coefficient(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let x = node.number(name);
    if x >= 0.0 && x.is_finite() {
        return Ok(x);
    }
    Err(ParameterError::new(name, format!("{x} is negative or not finite")))
}

fn exponential(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let log = node.number(name);
    if log.exp().is_finite() {
        return Ok(log.exp());
    }
    Err(ParameterError::new(name, format!("the exponential of {log} is not a coefficient")))
}
