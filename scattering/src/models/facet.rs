//! Facet models: specular reflection and refraction by tilted facets.

use super::brdf::Brdf;
use crate::spec::Spec;

pub mod bare;
mod batch;
mod parameters;
mod rotation;
pub mod shadowed;
pub mod shadowed_subsurface;
pub mod subsurface;

pub use parameters::FACET;

/// The models of this group, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Brdf>] =
    &[&bare::SPEC, &shadowed::SPEC, &subsurface::SPEC, &shadowed_subsurface::SPEC];
