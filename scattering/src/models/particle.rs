//! Particles on, in and below a surface.

use super::Brdf;
use crate::spec::{Parameter, Spec};

pub mod axisymmetric;
pub mod bobbert_vlieger;
pub mod double_interaction;
pub mod one_layer;
mod paths;
pub mod polydisperse_sphere;
pub mod rayleigh_defect;
pub mod rayleigh_stack;
mod small_sphere;
pub mod subsurface_particle;
mod supported;

/// The models of this group, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Brdf>] = &[
    &rayleigh_defect::SPEC,
    &rayleigh_stack::SPEC,
    &one_layer::SPEC,
    &subsurface_particle::SPEC,
    &double_interaction::SPEC,
    &polydisperse_sphere::SPEC,
    &bobbert_vlieger::SPEC,
    &bobbert_vlieger::SUBSURFACE,
    &axisymmetric::SPEC,
    &axisymmetric::SUBSURFACE,
];

/// The parameter of models that multiply the cross-section of a particle by their number.
pub const LOCAL: &[Parameter] =
    &[Parameter::number("density", "1", "1/um^2", "Number of particles per area")];
