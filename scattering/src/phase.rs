//! Scalar phase functions.

use crate::spec::{Family, Member, Spec};

/// A scalar phase function in 1/sr.
pub trait Phase: Send + Sync {
    /// p at the scattering angle `theta`, radians; ∫ p dΩ = 1 where a class says so.
    fn density(&self, theta: f64) -> f64;
}

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Phase>] = &[];

impl Member for dyn Phase {
    const FAMILY: Family = Family::Phase;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(ALL.iter().copied())
    }
}
