//! Diffuse bodies, bare or under an interface.

use super::Brdf;
use crate::spec::Spec;

pub mod lambertian;

/// The models of this group, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Brdf>] = &[&lambertian::SPEC];
