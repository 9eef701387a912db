//! Weighted sums of models, and models seen through a second face.

use super::brdf::Brdf;
use crate::spec::Spec;

pub mod four_source;
pub mod three_source;
pub mod transmit;
pub mod two_source;
mod weighted;

/// The models of this group, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Brdf>] =
    &[&two_source::SPEC, &three_source::SPEC, &four_source::SPEC, &transmit::SPEC];
