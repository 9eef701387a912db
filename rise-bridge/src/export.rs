//! Common parts of the exports of a material: its models at every wavelength, the error of a table,
//! the reasons for refusal.

mod bands;
mod error;
mod interpolation_error;
mod quasirandom;

pub use bands::Bands;
pub use error::ExportError;
pub use interpolation_error::InterpolationError;
pub(crate) use quasirandom::{r3_sequence, r4_sequence, weighted_quantile};
