//! Particles on, in and below a surface.

use super::brdf::Brdf;
use crate::spec::Spec;

pub mod axisymmetric;
pub mod bobbert_vlieger;
pub mod double_interaction;
mod local;
pub mod one_layer;
mod paths;
pub mod polydisperse_sphere;
pub mod rayleigh_defect;
pub mod rayleigh_stack;
mod small_sphere;
pub mod subsurface_particle;
mod supported;

pub use local::LOCAL;

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
