//! Spectral reflectances of diffuse bodies.

use crate::spec::{Family, Member, Spec};

pub mod equation;
pub mod kubelka_munk;
pub mod table;

/// A reflectance as a function of wavelength.
pub trait Reflectance: Send + Sync {
    /// R at the vacuum wavelength `lambda` µm.
    fn at(&self, lambda: f64) -> f64;
}

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Reflectance>] = &[&table::SPEC, &equation::SPEC, &kubelka_munk::SPEC];

impl Member for dyn Reflectance {
    const FAMILY: Family = Family::Reflectance;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(ALL.iter().copied())
    }
}
