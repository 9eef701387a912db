//! `MIST-TABLE 1`: the colour table as text.

use mist_engine::colour::ColourTable;

use super::{
    error::WriteError,
    header::{columns, header},
    rows::TextRows,
    style::Style,
};
use crate::column;

/// The table as `.mtab`.
///
/// # Errors
///
/// If a number is not finite.
pub fn mtab(table: &ColourTable, style: Style) -> Result<String, WriteError> {
    let names = column::names(table, style.xyz);
    let mut rows = TextRows::new(&names, style.digits);
    for row in &table.rows {
        rows.push(&column::values(table, row, style.xyz), Some(row.flags))?;
    }
    Ok(header(table, style.digits, &[]) + &columns(&names) + &rows.finish())
}
