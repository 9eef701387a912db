//! Tables as text.

/// Why a table cannot answer.
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
    #[error("no line of the file consists of numbers")]
    NoData,
    /// There is no such column.
    #[error("there is no column {column}{}", columns.map_or(String::new(), |n| format!("; the table has {n}")))]
    MissingColumn {
        /// The column asked for, from 1.
        column: i64,
        /// How many there are.
        columns: Option<usize>,
    },
}
