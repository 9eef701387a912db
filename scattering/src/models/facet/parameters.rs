//! The parameters that all facet models share.

use crate::{
    shadow::Shadow,
    slope::{self, SlopeDistribution},
    spec::{Parameter, ParameterError, ParameterNode},
    stack,
};

/// The parameters of every facet model: slopes, and films on the facets.
pub const FACET: &[Parameter] = &[
    Parameter::member(
        "sdf",
        &slope::FAMILY,
        "Exponential_Slope_Distribution_Function",
        "Density of facet slopes",
    ),
    Parameter::member("stack", &stack::FAMILY, "No_StackModel", "Films on each facet"),
];

/// The shadow function `name`, adapted to the slopes of the facets.
pub(super) fn read_shadow(
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
