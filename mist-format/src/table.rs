//! Files of numbers and of loop values: column tables, LIST files, formula files.
//!
//! Comments (`;` to the end of the line) are removed first. A comment in a last line without a line
//! end is refused, because NIST's program never finishes reading it.

mod columns;
mod error;
mod formula;
mod limits;
mod lines;
mod list;
mod rows;

pub use columns::ColumnTable;
pub use error::TableError;
pub use formula::{FormulaBody, FormulaFile, FormulaLoop, Working};
pub use limits::MAX_FORMULA_ROWS;
pub use list::{ListError, ListTable};

pub(crate) use lines::{lines, open_comment};
