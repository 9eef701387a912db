//! Files of numbers and of loop values: column tables, LIST files, formula files.
//!
//! All three drop comments (`;` to the end of the line) first. NIST's program never finishes
//! reading a comment in a last line without a line end, so that is refused.

mod columns;
mod formula;
mod list;

pub use columns::ColumnTable;
pub use formula::{Body, FormulaFile, FormulaLoop, MAX_FORMULA_ROWS, Working};
pub use list::{ListError, ListTable};

use crate::dialect::Quirk;

/// Why a table cannot be read or cannot answer.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TableError {
    /// The file cannot be read.
    #[error("cannot open file `{file}`: {reason}")]
    Unreadable {
        /// The file.
        file: String,
        /// Why.
        reason: String,
    },
    /// There is nothing in it.
    #[error("the file is empty")]
    Empty,
    /// There are no rows of numbers.
    #[error("no line of the file consists of numbers separated by blanks")]
    NoData,
    /// There is no such column.
    #[error("there is no column {column}{}", having(*columns))]
    MissingColumn {
        /// The column asked for, from 1.
        column: i64,
        /// How many there are.
        columns: Option<usize>,
    },
    /// A comment in the last line, which has no line end: NIST's program never ends.
    #[error("line {line}: a comment in the last line, which has no line end")]
    OpenComment {
        /// The line, from 1.
        line: usize,
    },
    /// Something that NIST's program reads otherwise than written.
    #[error("line {line}: `{item}` is no number")]
    Refused {
        /// The line, from 1.
        line: usize,
        /// What stands there.
        item: String,
        /// How NIST's program reads it.
        quirk: Quirk,
    },
    /// A formula file that does not follow its grammar.
    #[error("line {line}: expected {expected}")]
    Formula {
        /// The line, from 1.
        line: usize,
        /// What should stand there.
        expected: String,
    },
    /// A formula that cannot be computed.
    #[error("`{expression}`: {reason}")]
    Expression {
        /// The formula.
        expression: String,
        /// Why.
        reason: String,
    },
    /// A formula file makes more than [`MAX_FORMULA_ROWS`] rows.
    #[error("the loop makes more than {MAX_FORMULA_ROWS} rows")]
    TooManyRows,
}

fn having(columns: Option<usize>) -> String {
    columns.map_or(String::new(), |columns| format!(", the table has {columns}"))
}

/// A line without its comment, and whether it has a line end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line<'t> {
    number: usize,
    pub(crate) text: &'t str,
    /// Offset of the text in the file.
    start: usize,
    ended: bool,
    commented: bool,
}

/// The lines of a file without comments.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    let mut start = 0;
    text.split_inclusive('\n').enumerate().map(move |(place, line)| {
        let ended = line.ends_with('\n');
        let body = line.trim_end_matches(['\n', '\r']);
        let comment = body.find(';');
        let text = &body[..comment.unwrap_or(body.len())];
        let found = Line { number: place + 1, text, start, ended, commented: comment.is_some() };
        start += line.len();
        found
    })
}

/// The number of a last line that NIST's program never finishes.
pub(crate) fn open_comment(text: &str) -> Option<usize> {
    lines(text).last().filter(|line| line.commented && !line.ended).map(|line| line.number)
}
