//! The family of shadowing functions: its interface, and what its classes share.

use crate::{
    Direction, Incidence,
    slope::SlopeDistribution,
    spec::{self, Family, ParameterError},
};

/// The family of shadowing functions.
pub static FAMILY: Family =
    Family::new("Shadow_Function", "Shadowing functions", spec::classes::<dyn Shadow>);

/// The fraction of facets that both the source and the detector see.
pub trait Shadow: Send + Sync {
    /// G for the beam `incidence` (with the rotation of the sample) and the exit `direction`.
    fn fraction(&self, incidence: &Incidence, direction: &Direction) -> f64;

    /// G for many directions of one beam; `out` has the length of `directions`.
    ///
    /// Overridden where a batch can share work; the numbers do not change by it.
    fn fractions(&self, incidence: &Incidence, directions: &[Direction], out: &mut [f64]) {
        for (fraction, direction) in out.iter_mut().zip(directions) {
            *fraction = self.fraction(incidence, direction);
        }
    }

    /// Takes from the slopes of the facets what its own parameters leave open.
    ///
    /// # Errors
    ///
    /// If a parameter is left open and the slopes do not determine it.
    fn adapt(&mut self, _: &dyn SlopeDistribution) -> Result<(), ParameterError> {
        Ok(())
    }
}
