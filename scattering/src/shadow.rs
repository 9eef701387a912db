//! Shadowing functions: the fraction of facets that is lit and seen.

use crate::spec::{Family, Member, Spec};

/// The fraction of facets that both the source and the detector see.
pub trait Shadow: Send + Sync {
    /// G for the beam `incidence` (with the rotation of the sample) and the exit `direction`.
    fn fraction(&self, incidence: &crate::Incidence, direction: &crate::Direction) -> f64;
}

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Shadow>] = &[];

impl Member for dyn Shadow {
    const FAMILY: Family = Family::Shadow;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(ALL.iter().copied())
    }
}
