//! Gratings: every diffracted order is a cone of light.

use super::brdf::Brdf;
use crate::spec::Spec;

mod cone;
mod convergence;
pub mod cross;
pub mod line;
mod orders;

/// The models of this group, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Brdf>] = &[&line::SPEC, &cross::SPEC];
