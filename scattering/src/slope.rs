//! Slope distributions: the density of facet slopes.

use crate::spec::{Family, Member, Spec};

/// A density of facet slopes; ∫∫ S dζ_x dζ_y = 1 where a class says so.
pub trait SlopeDistribution: Send + Sync {
    /// S(ζ_x, ζ_y), slopes in the frame of the sample.
    fn density(&self, zeta_x: f64, zeta_y: f64) -> f64;
}

/// All of them, in the order they are listed to users.
pub const ALL: &[&Spec<dyn SlopeDistribution>] = &[];

impl Member for dyn SlopeDistribution {
    const FAMILY: Family = Family::Slope;

    fn specs() -> Box<dyn Iterator<Item = &'static Spec<Self>>> {
        Box::new(ALL.iter().copied())
    }
}
