//! What steps share: models with equal parameters, layouts of equal apertures, and the Mueller
//! integrals that both determine.
//!
//! A loop over a polarization or an output evaluates no model again, and a loop over the
//! wavelength lays out no aperture again. Caches are emptied when they have grown large; that
//! costs time, never changes a number.

mod kept;
mod models;
mod work;

pub(crate) use kept::Map;
pub(crate) use work::Shared;
