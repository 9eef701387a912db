//! Coatings of pigments and clear layers.
//!
//! What an interface lets pass is kept as factors of s, p and their coherence; what a rough one
//! sends back is tabulated when a model is built, so that what it lets pass is the rest. Models
//! below a coat are built immersed: for light that comes from inside the coat.

use super::brdf::Brdf;
use crate::spec::Spec;

mod body;
mod coat;
mod cover;
mod directional_albedo;
mod doubling;
mod energy_compensation;
mod flakes;
mod immersed;
mod interface;
mod interreflection;
pub mod layer;
pub mod layered;
pub mod pigmented;
mod published;
mod transmission;

/// The models of this group, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Brdf>] = &[&pigmented::SPEC, &layered::SPEC];
