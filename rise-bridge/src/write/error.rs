//! Errors of writing a table.

/// Errors of writing a table.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum WriteError {
    /// A number is not finite; the formats hold finite numbers only.
    #[error("row {row} has {value} in column {column}: tables hold finite numbers only")]
    NotFinite {
        /// Row, from 1.
        row: usize,
        /// Name of the column.
        column: String,
        /// The number.
        value: f64,
    },
    /// The picture cannot be made; the reason.
    #[error("the picture cannot be made: {0}")]
    Picture(String),
    /// A row does not have one value per wavelength.
    #[error("row {row} has no spectrum of {component}")]
    NoSpectrum {
        /// Row, from 1.
        row: usize,
        /// The Stokes component: I, Q, U or V.
        component: char,
    },
}
