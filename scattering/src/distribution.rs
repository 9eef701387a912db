//! Densities of a particle diameter.

use crate::spec::{Family, Member, Spec};

/// A probability density of a diameter.
pub trait Distribution: Send + Sync {
    /// Density in 1/µm at the diameter `d` µm.
    fn density(&self, d: f64) -> f64;
}

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Distribution>] = &[];

impl Member for dyn Distribution {
    const FAMILY: Family = Family::Distribution;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(ALL.iter().copied())
    }
}
