//! Crossed gratings: profiles that repeat along two axes, cut into slices.
//!
//! Axis 1 is x; axis 2 leans from y towards x by ζ (`zeta`), so that a place with the oblique
//! coordinates (x₁, x₂) is at x = x₁ + x₂ sin ζ, y = x₂ cos ζ. Slices are listed from the top.

use crate::spec::{Member, Spec};

pub mod cylinder;
mod family;
pub mod generic;
mod grid;
mod lattice;
pub mod null;
pub mod one_d;
pub mod overlaid;
pub mod overlaid_1d;
mod pattern;
pub mod pyramidal_pit;
pub mod rectangle;
pub mod sphere;

pub(crate) use family::same;
pub use family::{CrossGrating, CrossGratingMedia, CrossProfile, FAMILY, MEDIA};
pub use grid::PixelGrid;
pub use lattice::Lattice;
pub(crate) use lattice::lean;
pub use pattern::{CrossPattern, CrossSlice, HarmonicTruncation, ObliqueRule};

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn CrossGrating>] = &[
    &one_d::SPEC,
    &cylinder::SPEC,
    &rectangle::SPEC,
    &sphere::SPEC,
    &pyramidal_pit::SPEC,
    &generic::SPEC,
    &overlaid::SPEC,
    &overlaid_1d::SPEC,
    &null::SPEC,
];

impl Member for dyn CrossGrating {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[ALL];
}
