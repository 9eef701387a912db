//! The parameter of models of particles with a number per area.

use crate::spec::Parameter;

/// The parameter of models that multiply the cross-section of a particle by their number.
pub const LOCAL: &[Parameter] =
    &[Parameter::number("density", 1.0, "1/um^2", "Number of particles per area")];
