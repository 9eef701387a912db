//! Limits of tables.

/// The largest number of rows of a formula file.
pub const MAX_FORMULA_ROWS: usize = 1_000_000;
