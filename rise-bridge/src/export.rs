//! What every export of a material needs: its models at every wavelength, and reasons to refuse.

mod bands;
mod error;
mod even;
mod spread;

pub use bands::Bands;
pub use error::ExportError;
pub(crate) use even::{even, even_in_four, quantile};
pub use spread::Spread;
