//! Mueller-valued phase functions with coefficients of absorption and scattering.

use crate::spec::{Family, Member, Spec};

/// A phase matrix with the coefficients of the medium that scatters.
pub trait PolarizedPhase: Send + Sync {
    /// Phase matrix in the (∥, ⊥) basis of the scattering plane, ∫ P00 dΩ = 1; radians.
    fn matrix(&self, theta: f64) -> crate::Mueller;
    /// Absorption coefficient, 1/µm.
    fn absorption(&self) -> f64;
    /// Scattering coefficient, 1/µm.
    fn scattering(&self) -> f64;
}

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn PolarizedPhase>] = &[];

impl Member for dyn PolarizedPhase {
    const FAMILY: Family = Family::PolarizedPhase;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(ALL.iter().copied())
    }
}
