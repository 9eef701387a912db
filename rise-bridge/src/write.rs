//! Writers of colour tables: `.mtab`, `.mspd`, JSON, SVG.

mod error;
mod header;
mod json;
mod mspd;
mod mtab;
mod mueller;
mod plot;
mod rows;
mod style;

pub use error::WriteError;
pub use json::json;
pub use mspd::{component_name, mspd};
pub use mtab::mtab;
pub use mueller::{mueller, mueller_json, spectra_json};
pub use plot::{plot, plot_comparisons};
pub use style::Style;

pub(crate) use header::MAGIC;
pub(crate) use rows::checksum;
