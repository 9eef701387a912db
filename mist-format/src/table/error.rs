//! Errors of tables.

use super::limits::MAX_FORMULA_ROWS;
use crate::dialect::TextDeviation;

/// Errors of reading or evaluating a table.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TableError {
    /// The file cannot be read.
    #[error("cannot open file `{file}`: {reason}")]
    Unreadable {
        /// The file.
        file: String,
        /// The reason.
        reason: String,
    },
    /// The file is empty.
    #[error("the file is empty")]
    Empty,
    /// The file has no rows of numbers.
    #[error("no line of the file consists of numbers separated by blanks")]
    NoData,
    /// There is no such column.
    #[error("there is no column {column}{}", having(*columns))]
    MissingColumn {
        /// The requested column, from 1.
        column: i64,
        /// The number of columns.
        columns: Option<usize>,
    },
    /// A comment in the last line, which has no line end: NIST's program never ends.
    #[error("line {line}: a comment in the last line, which has no line end")]
    OpenComment {
        /// The line, from 1.
        line: usize,
    },
    /// An item that NIST's program misreads.
    #[error("line {line}: `{item}` is not a number")]
    Refused {
        /// The line, from 1.
        line: usize,
        /// The item.
        item: String,
        /// The deviation of NIST's program.
        deviation: TextDeviation,
    },
    /// A numeric line with fewer numbers than the first one.
    #[error(
        "line {line}: {found} numbers, but line {first} has {expected}; if line {first} is a heading, \
         begin it with `;`"
    )]
    ShortRow {
        /// The line, from 1.
        line: usize,
        /// Numbers in the line.
        found: usize,
        /// Numbers in the first line.
        expected: usize,
        /// The first line of numbers, from 1.
        first: usize,
    },
    /// A comma that is decimal, or may be.
    #[error("line {line}: `{item}` has a decimal comma; write decimal points")]
    DecimalComma {
        /// The line, from 1.
        line: usize,
        /// The item.
        item: String,
    },
    /// A second table that is not k over the abscissae of the first.
    #[error(
        "line {line}: a second table begins; keep one table per file, with columns for n and k"
    )]
    SecondTable {
        /// The line of its heading, from 1.
        line: usize,
    },
    /// A violation of the grammar of formula files.
    #[error("line {line}: expected {expected}")]
    Formula {
        /// The line, from 1.
        line: usize,
        /// The expected item.
        expected: String,
    },
    /// A formula that cannot be computed.
    #[error("`{expression}`: {reason}")]
    Expression {
        /// The formula.
        expression: String,
        /// The reason.
        reason: String,
    },
    /// A formula file makes more than [`MAX_FORMULA_ROWS`] rows.
    #[error("the loop makes more than {MAX_FORMULA_ROWS} rows")]
    TooManyRows,
}

fn having(columns: Option<usize>) -> String {
    columns.map_or(String::new(), |columns| format!(", the table has {columns}"))
}
