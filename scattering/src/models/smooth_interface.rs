//! The smooth interface between vacuum and a substrate, with the films on it.

use num_complex::Complex64;

use super::brdf::CommonParameters;
use crate::{
    optics::film::Films,
    spec::{Parameter, ParameterError, ParameterNode},
    stack::{self, Stack},
};

/// The parameter of models with a smooth interface: the films on it.
pub(super) const INTERFACE: &[Parameter] =
    &[Parameter::member("stack", &stack::FAMILY, "No_StackModel", "Films on the interface")];

/// The films of `node` between vacuum and `substrate`.
pub(super) fn interface(
    node: &ParameterNode,
    common: &CommonParameters,
    substrate: Complex64,
) -> Result<Films, ParameterError> {
    if !(substrate.re > 0.0 && substrate.is_finite()) {
        return Err(ParameterError::new("substrate", format!("{substrate} is not an index")));
    }
    let films = node.member::<Stack>("stack")?.at(common.lambda);
    Ok(Films::new(&films, Complex64::ONE, substrate, common.lambda))
}
