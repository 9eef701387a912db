//! Reads text tables; every defect of the text is found and located.

mod error;
mod mspd;
mod mtab;
mod text;

pub use error::ReadError;
pub use mspd::{SpectraRow, SpectraTable, mspd};
pub use mtab::mtab;
