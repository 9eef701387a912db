//! Mueller-valued phase functions with coefficients of absorption and scattering.

use crate::{
    Mueller, ParameterNode,
    phase::Phase,
    spec::{Family, Member, Parameter, ParameterError, Spec},
};

pub mod code_whitney;
pub mod constrained;
pub mod distributed_mie;
pub mod sphere;
pub mod unpolarized;

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

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn PolarizedPhase>] = &[
    &unpolarized::SPEC,
    &code_whitney::SPEC,
    &constrained::SPEC,
    &sphere::SPEC,
    &distributed_mie::SPEC,
];

impl Member for dyn PolarizedPhase {
    const FAMILY: Family = Family::PolarizedPhase;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(ALL.iter().copied())
    }
}

/// The parameters of phase matrices that multiply a scalar phase function.
pub const SCALAR: &[Parameter] = &[
    Parameter::member(
        "phase_function",
        Family::Phase,
        "Phase_Function",
        "Henyey_Greenstein_Phase_Function",
        "Scalar phase function",
    ),
    Parameter::number(
        "log_absorption",
        "-20",
        "ln(1/um)",
        "Natural logarithm of the absorption coefficient",
    ),
    Parameter::number(
        "log_scattering",
        "0",
        "ln(1/um)",
        "Natural logarithm of the scattering coefficient",
    ),
];

/// A scalar phase function with the coefficients that stand beside it.
struct ScalarPhase {
    phase: Box<dyn Phase>,
    absorption: f64,
    scattering: f64,
}

impl ScalarPhase {
    fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        Ok(Self {
            phase: node.member::<dyn Phase>("phase_function")?,
            absorption: exponential(node, "log_absorption")?,
            scattering: exponential(node, "log_scattering")?,
        })
    }
}

fn exponential(node: &ParameterNode, name: &str) -> Result<f64, ParameterError> {
    let log = node.number(name);
    if log.exp().is_finite() {
        return Ok(log.exp());
    }
    Err(ParameterError::new(name, format!("the exponential of {log} is no coefficient")))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;
    use crate::{Mode, special::gauss};

    #[test]
    fn every_default_scatters_all_it_takes_from_the_beam() {
        for spec in ALL {
            let node = ParameterNode::with_defaults(&spec.class, Mode::Sound);
            // Spheres of up to 100 µm have lobes that few nodes do not see.
            if spec.class.name == "Distributed_Mie_Phase_Function" {
                continue;
            }
            let phase = (spec.build)(&node).unwrap();
            let total = gauss::integrate(100, 0.0, PI, |t| {
                TAU * t.sin() * phase.at_cosine(t.cos())[(0, 0)]
            });
            assert!((total - 1.0).abs() < 1e-12, "{}: {total}", spec.class.name);
            assert!(phase.scattering() > 0.0 && phase.absorption() >= 0.0);
        }
    }
}
