//! Spectral reflectances of diffuse bodies.

use crate::spec::{Member, Spec};

pub mod equation;
mod family;
pub mod kubelka_munk;
pub mod table;

pub use family::{FAMILY, Reflectance, read};

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Reflectance>] = &[&table::SPEC, &equation::SPEC, &kubelka_munk::SPEC];

impl Member for dyn Reflectance {
    const CLASSES: &'static [&'static [&'static Spec<Self>]] = &[ALL];
}
