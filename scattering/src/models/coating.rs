//! Coatings of pigments and clear layers.
//!
//! Light that crosses an interface of a coating is a [`passage::Passage`]; what a rough interface
//! sends back is kept in a table ([`returned`]), so that what it lets pass is the rest. Models
//! below a coat are built [`immersed`]: for light that comes from inside the coat.

use super::Brdf;
use crate::spec::Spec;

mod body;
mod doubling;
mod flakes;
mod immersed;
mod interface;
pub mod layer;
pub mod layered;
mod passage;
pub mod pigmented;
mod returned;

/// The models of this group, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Brdf>] = &[&pigmented::SPEC, &layered::SPEC];
