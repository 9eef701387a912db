//! Coatings of pigments and clear layers.

use super::Brdf;
use crate::spec::Spec;

/// The models of this group, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Brdf>] = &[];
