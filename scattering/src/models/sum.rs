//! Weighted sums of models, and models seen through a second face.

use super::Brdf;
use crate::spec::Spec;

/// The models of this group, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Brdf>] = &[];
