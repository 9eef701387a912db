//! Diffuse bodies, bare or under an interface.

use super::brdf::Brdf;
use crate::spec::Spec;

pub mod diffuse_subsurface;
pub mod first_diffuse;
pub mod lambertian;

/// The models of this group, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Brdf>] =
    &[&lambertian::SPEC, &diffuse_subsurface::SPEC, &first_diffuse::SPEC];
