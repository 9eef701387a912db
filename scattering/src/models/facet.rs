//! Facet models: specular reflection and refraction by tilted facets.

use super::Brdf;
use crate::{
    ParameterError,
    shadow::Shadow,
    slope::SlopeDistribution,
    spec::{Family, Parameter, ParameterNode, Spec},
};

pub mod bare;
mod batch;
pub mod shadowed;
pub mod shadowed_subsurface;
pub mod subsurface;
mod turn;

/// The models of this group, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Brdf>] =
    &[&bare::SPEC, &shadowed::SPEC, &subsurface::SPEC, &shadowed_subsurface::SPEC];

/// The parameters of every facet model: slopes, and films on the facets.
pub const FACET: &[Parameter] = &[
    Parameter::member(
        "sdf",
        Family::Slope,
        "Slope_Distribution_Function",
        "Exponential_Slope_Distribution_Function",
        "Density of facet slopes",
    ),
    Parameter::member("stack", Family::Stack, "StackModel", "No_StackModel", "Films on each facet"),
];

/// The shadow function `name`, adapted to the slopes of the facets.
fn read_shadow(
    node: &ParameterNode,
    name: &str,
    slopes: &dyn SlopeDistribution,
) -> Result<Box<dyn Shadow>, ParameterError> {
    let mut shadow = node.member::<dyn Shadow>(name)?;
    shadow.adapt(slopes).map_err(|error| {
        ParameterError::new(&format!("{name}.{}", error.parameter), error.problem)
    })?;
    Ok(shadow)
}
