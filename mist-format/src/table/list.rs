//! LIST files: names in the first line, then one row of loop values per line.

use super::lines::{lines, open_comment};
use crate::dialect::{Dialect, TextDeviation};
use crate::span::Span;

/// The names and rows of a LIST file.
#[derive(Clone, Debug, PartialEq)]
pub struct ListTable {
    text: String,
    names: Vec<Span>,
    /// Row after row.
    cells: Vec<Span>,
}

/// Errors of reading a LIST file. Lines count from 1.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ListError {
    /// The first line names no columns.
    #[error("line 1: the first line must name the columns")]
    NoNames,
    /// There are no rows.
    #[error("no points in LIST loop")]
    NoPoints,
    /// A row has fewer columns than there are names.
    #[error("line {line}: error reading column: {found} of {expected} columns")]
    ShortRow {
        /// The line.
        line: usize,
        /// Columns of the row.
        found: usize,
        /// Names in the first line.
        expected: usize,
    },
    /// A comment in the last line, which has no line end: NIST's program never ends.
    #[error("line {line}: a comment in the last line, which has no line end")]
    OpenComment {
        /// The line.
        line: usize,
    },
}

impl ListTable {
    /// Reads a LIST file; the rows end at the first blank line. Further columns than names are
    /// ignored. Compat: the last line is dropped if it has no line end; sound: it is kept.
    ///
    /// # Errors
    /// See [`ListError`].
    pub fn parse(text: &str, dialect: Dialect) -> Result<Self, ListError> {
        let mut names = Vec::new();
        let mut cells = Vec::new();
        let mut end = text.len();
        for line in lines(text) {
            if !line.ended && TextDeviation::DroppedLastLine.applies_in(dialect) {
                break;
            }
            let words = words(line.text, line.start);
            if line.number == 1 {
                names = words.collect();
                if names.is_empty() {
                    return Err(ListError::NoNames);
                }
                continue;
            }
            if line.text.trim().is_empty() {
                end = line.start;
                break;
            }
            let before = cells.len();
            cells.extend(words.take(names.len()));
            let found = cells.len() - before;
            if found < names.len() {
                let (line, expected) = (line.number, names.len());
                return Err(ListError::ShortRow { line, found, expected });
            }
        }
        if let Some(line) = open_comment(text).filter(|_| end == text.len()) {
            return Err(ListError::OpenComment { line });
        }
        if cells.is_empty() {
            return Err(ListError::NoPoints);
        }
        Ok(Self { text: text.to_owned(), names, cells })
    }

    /// The names of the columns as written: `x`, `#x` or `$x`.
    pub fn names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.names.iter().map(|name| name.of(&self.text))
    }

    /// The span of each name in the file.
    pub fn name_spans(&self) -> &[Span] {
        &self.names
    }

    /// The number of rows, at least one.
    pub fn row_count(&self) -> usize {
        self.cells.len() / self.names.len().max(1)
    }

    /// The text of a cell; both indices count from 0. Empty outside of the table.
    pub fn cell(&self, row: usize, column: usize) -> &str {
        self.cell_span(row, column).map_or("", |cell| cell.of(&self.text))
    }

    /// The span of a cell in the file.
    pub fn cell_span(&self, row: usize, column: usize) -> Option<Span> {
        if column >= self.names.len() {
            return None;
        }
        self.cells.get(row.checked_mul(self.names.len())?.checked_add(column)?).copied()
    }
}

/// The spans of the words of a line.
fn words(line: &str, start: usize) -> impl Iterator<Item = Span> {
    line.split_ascii_whitespace().map(move |word| {
        let at = start + (word.as_ptr() as usize - line.as_ptr() as usize);
        Span::new(at, at + word.len())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_end_at_a_blank_line() {
        let text = "a  b\tc ; header\n7.2 4*2 (1,2) more ; c\n3 4 5\n   \n9 9 9\n";
        let list = ListTable::parse(text, Dialect::Sound).unwrap();
        assert_eq!(list.names().collect::<Vec<_>>(), ["a", "b", "c"]);
        assert_eq!(list.row_count(), 2);
        assert_eq!(list.cell(0, 2), "(1,2)");
        assert_eq!(list.cell(1, 0), "3");
        assert_eq!(list.cell(0, 3), "");
        assert_eq!(list.cell(2, 0), "");
    }

    #[test]
    fn a_last_line_without_an_end_is_dropped_by_nist_only() {
        let text = "a b\n1 2\n7 9";
        assert_eq!(ListTable::parse(text, Dialect::Compat).unwrap().row_count(), 1);
        assert_eq!(ListTable::parse(text, Dialect::Sound).unwrap().row_count(), 2);
    }

    #[test]
    fn invalid_lists_are_refused() {
        let error = |text| ListTable::parse(text, Dialect::Sound).unwrap_err();
        assert_eq!(error("\n1 2\n"), ListError::NoNames);
        assert_eq!(error("a b\n"), ListError::NoPoints);
        assert_eq!(error(""), ListError::NoPoints);
        assert_eq!(error("a b\n1\n"), ListError::ShortRow { line: 2, found: 1, expected: 2 });
        assert_eq!(error("a b\n1 2 ; c"), ListError::OpenComment { line: 2 });
    }
}
