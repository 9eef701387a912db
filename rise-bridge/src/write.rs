//! A colour table as text: for renderers, for programs, for people.

mod header;
mod json;
mod mspd;
mod mtab;
mod mueller;
mod plot;
mod rows;

pub use json::json;
pub use mspd::{component_name, mspd};
pub use mtab::mtab;
pub use mueller::{mueller, mueller_json, spectra_json};
pub use plot::{plot, plot_comparisons};

pub(crate) use header::MAGIC;
pub(crate) use rows::checksum;

/// How numbers are written in text tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    /// Significant digits: 9 bring every f32 back, 17 every f64.
    pub digits: usize,
    /// Whether the columns X Y Z follow the colours.
    pub xyz: bool,
}

impl Default for Style {
    /// Nine digits, no XYZ.
    fn default() -> Self {
        Self { digits: 9, xyz: false }
    }
}

/// Why a table cannot be written.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum WriteError {
    /// The formats have no text for infinity and not-a-number.
    #[error("row {row} has {value} in column {column}: tables hold finite numbers only")]
    NotFinite {
        /// Row, from 1.
        row: usize,
        /// Name of the column.
        column: String,
        /// The number.
        value: f64,
    },
    /// Spectra were asked for, but a row does not have one value for every wavelength.
    #[error("row {row} has no spectrum of {component}")]
    NoSpectrum {
        /// Row, from 1.
        row: usize,
        /// The Stokes component: I, Q, U or V.
        component: char,
    },
}
