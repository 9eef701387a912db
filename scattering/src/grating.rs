//! Line gratings: periodic profiles cut into lamellar slices.
//!
//! A grating repeats along its x axis and is uniform along y. Its slices are listed from the top
//! down; in a slice the material depends on x alone.

use crate::spec::{Member, Spec};

pub mod corner_rounded;
pub mod dielectric_stack;
mod family;
pub mod generic;
pub mod overlaid;
mod pattern;
pub mod single_line;
pub mod sinusoidal_relief;
pub mod sinusoidal_volume;
pub mod triangular;

pub use family::{COMMON, FAMILY, Grating, GratingCommon, LineProfile, LineSlice};
pub(crate) use family::{finite, levels, not_negative, positive};
pub use pattern::{CosineReciprocal, GratingMaterial, LinePattern};

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Grating>] = &[
    &single_line::SPEC,
    &sinusoidal_relief::SPEC,
    &sinusoidal_volume::SPEC,
    &triangular::SPEC,
    &corner_rounded::SPEC,
    &dielectric_stack::SPEC,
    &overlaid::SPEC,
    &generic::SPEC,
];

impl Member for dyn Grating {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[ALL];
}
