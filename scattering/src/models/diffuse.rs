//! Diffuse bodies, bare or under an interface.

use num_complex::Complex64;

use super::{Brdf, CommonParameters};
use crate::{
    ParameterError, ParameterNode,
    optics::film::Films,
    spec::{Family, Parameter, Spec},
    stack::Stack,
};

pub mod diffuse_subsurface;
pub mod first_diffuse;
pub mod lambertian;

/// The models of this group, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Brdf>] =
    &[&lambertian::SPEC, &diffuse_subsurface::SPEC, &first_diffuse::SPEC];

/// The parameter of models with a smooth interface: the films on it.
pub(super) const INTERFACE: &[Parameter] = &[Parameter::member(
    "stack",
    Family::Stack,
    "StackModel",
    "No_StackModel",
    "Films on the interface",
)];

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
