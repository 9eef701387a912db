//! Coatings of pigments and clear layers.
//!
//! The transmission of an interface is stored as factors of s, p and their coherence. The
//! directional albedo of a rough interface is tabulated when a model is built; the rest is
//! transmitted. Models below a coat are built immersed: for light that comes from inside the coat.

use super::brdf::Brdf;
use crate::spec::Spec;

pub mod adding_doubling;
mod backing;
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
pub mod paint;
pub mod paint_face;
pub mod paint_flakes;
pub mod pigmented;
mod published;
pub mod smooth_surface;
mod transmission;

/// The models of this group, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Brdf>] =
    &[&pigmented::SPEC, &layered::SPEC, &adding_doubling::SPEC, &smooth_surface::SPEC];
