//! Writers of colour tables: `.mtab`, `.mspd`, JSON, CSV, SVG, PNG, PDF.

mod csv;
mod error;
mod header;
mod json;
mod mspd;
mod mtab;
mod mueller;
mod picture;
mod plot;
mod rows;
mod style;

pub use csv::{csv, csv_spectra};
pub use error::WriteError;
pub use json::json;
pub use mspd::{component_name, mspd};
pub use mtab::mtab;
pub use mueller::{mueller, mueller_json, spectra_json};
pub use picture::{pdf, png};
pub use plot::{Graph, Mark, Series, plot, plot_comparisons, plot_graphs};
pub use style::Style;

pub(crate) use header::MAGIC;
pub(crate) use rows::checksum;
