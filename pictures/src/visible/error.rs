//! Errors of comparing two pictures.

/// The largest number of pixels (8K); a comparison takes about 150 bytes per pixel.
pub const MOST_PIXELS: usize = 1 << 25;

/// Errors of comparing two pictures.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VisibleError {
    /// The number of values is not that of the pixels.
    #[error("a picture of {width} × {height} pixels has {found} values")]
    Values {
        /// Pixels in a row.
        width: usize,
        /// Rows.
        height: usize,
        /// Values that were given.
        found: usize,
    },
    /// The picture is too small or too large.
    #[error(
        "a picture of {width} × {height} pixels cannot be compared: it must have 2 × 2 to \
         {MOST_PIXELS} pixels; cut or scale it"
    )]
    Size {
        /// Pixels in a row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// A luminance is infinite.
    #[error("the luminance at column {column}, row {row} is infinite")]
    Infinite {
        /// Column, from 0.
        column: usize,
        /// Row, from 0.
        row: usize,
    },
    /// The pictures have different sizes.
    #[error(
        "the test has {} × {} pixels, the reference {} × {}: they must show the same view",
        .test[0], .test[1], .reference[0], .reference[1]
    )]
    Differ {
        /// Columns and rows of the test.
        test: [usize; 2],
        /// Columns and rows of the reference.
        reference: [usize; 2],
    },
    /// A viewing condition is not a positive number.
    #[error("{name} is {value}; it must be a positive number ({unit})")]
    Viewing {
        /// The viewing condition.
        name: &'static str,
        /// The value.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// FLIP is not defined for the pictures.
    #[error("FLIP cannot compare the pictures: {0}")]
    Flip(String),
}
