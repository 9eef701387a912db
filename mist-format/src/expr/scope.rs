//! The variables and files of an expression.

use crate::table::TableError;

/// The variables and files of an expression.
pub trait Scope {
    /// The elements of the variable in this slot (see [`Expr::bind`](super::Expr::bind)), if it is defined.
    fn variable(&self, slot: u32) -> Option<&[f64]>;

    /// The number in this slot, if it holds a single one.
    fn number(&self, slot: u32) -> Option<f64> {
        match self.variable(slot) {
            Some(&[one]) => Some(one),
            _ => None,
        }
    }

    /// The value of column `column` (1 = the abscissa) of a table at `x`.
    ///
    /// # Errors
    /// The file cannot be read, or has no such column.
    fn table(&mut self, file: &str, x: f64, column: i64) -> Result<f64, TableError> {
        let _ = (x, column);
        Err(TableError::Unreadable { file: file.into(), reason: "no files here".into() })
    }
}

/// A scope without variables and files.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoNames;

impl Scope for NoNames {
    fn variable(&self, _: u32) -> Option<&[f64]> {
        None
    }
}

/// x or −x.
pub(super) fn signed(x: f64, negative: bool) -> f64 {
    if negative { -x } else { x }
}
