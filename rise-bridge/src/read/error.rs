//! Errors of reading a text table.

/// Errors of reading a text table.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReadError {
    /// The first line is not that of a table.
    #[error("line 1: the first line is not \"# MIST-TABLE 1\"")]
    NotATable,
    /// A header line has a value that its key cannot have.
    #[error("line {line}: {key}: {problem}")]
    Header {
        /// Line, from 1.
        line: usize,
        /// The key.
        key: String,
        /// The problem, and what is expected.
        problem: String,
    },
    /// A header line is missing.
    #[error("the header has no line \"# {0}\"")]
    Missing(&'static str),
    /// A line has a control character: the file is damaged or not a text.
    #[error("line {line}, column {column}: the control character {found:?}: is this file damaged?")]
    Control {
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
        /// The character.
        found: char,
    },
    /// A header line stands after the first row.
    #[error("line {0}: a header line after the rows have begun")]
    LateHeader(usize),
    /// A row has a word that is not a finite number.
    #[error("line {line}, column {column}: {text:?} is not a finite number")]
    Number {
        /// Line, from 1.
        line: usize,
        /// Name of the column.
        column: String,
        /// The word.
        text: String,
    },
    /// A row has too few or too many numbers.
    #[error("line {line}: {found} numbers for {expected} columns")]
    Width {
        /// Line, from 1.
        line: usize,
        /// Numbers in the row.
        found: usize,
        /// Columns.
        expected: usize,
    },
    /// The last line is missing: the table is truncated.
    #[error("the table is truncated after {0} rows: its last line \"# end …\" is missing")]
    Truncated(usize),
    /// Rows are missing or duplicated.
    #[error("{found} rows where {by} says {stated}")]
    RowCount {
        /// Rows in the text.
        found: usize,
        /// The stated number of rows.
        stated: usize,
        /// The line that states it.
        by: &'static str,
    },
    /// The rows were changed after writing.
    #[error("the rows were changed: their checksum is {found}, \"# end\" says {stated}")]
    Checksum {
        /// The checksum of the rows in the text.
        found: String,
        /// The checksum in the last line.
        stated: String,
    },
    /// Text stands after the last line.
    #[error("line {0}: text after \"# end\"")]
    AfterEnd(usize),
}
