//! What steps share: models with equal parameters, layouts of equal apertures, and the Mueller
//! integrals that both determine.
//!
//! A loop over a polarization or an output evaluates no model again, and a loop over the
//! wavelength lays out no aperture again. Caches are emptied when they have grown large; that
//! costs time, never changes a number.

mod cache;
mod evaluator;
mod models;

pub(crate) use cache::FastMap;
pub(crate) use evaluator::Evaluator;
