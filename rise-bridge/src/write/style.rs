//! The style of numbers in text tables.

/// The style of text tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    /// Significant digits: 9 are exact for f32, 17 for f64.
    pub digits: usize,
    /// Write the columns X Y Z after the colours.
    pub xyz: bool,
}

impl Default for Style {
    /// Nine digits, no XYZ.
    fn default() -> Self {
        Self { digits: 9, xyz: false }
    }
}
