//! The cells of a line of a table: separators, quotes, units behind names.

/// The separator of the columns of a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Separator {
    Tab,
    Semicolon,
    Comma,
    Blanks,
}

impl Separator {
    /// The separator of the line of names.
    pub(super) fn of(line: &str) -> Self {
        let line = line.trim_end();
        match line {
            _ if line.contains('\t') => Self::Tab,
            _ if line.contains(';') => Self::Semicolon,
            _ if line.contains(',') => Self::Comma,
            _ => Self::Blanks,
        }
    }

    /// The cells of the line of names; a separator at its end separates nothing.
    pub(super) fn cells(self, line: &str) -> Vec<String> {
        let mut cells = self.split(line);
        if cells.len() > 1 && cells.last().is_some_and(String::is_empty) {
            cells.pop();
        }
        cells
    }

    /// The cells of a row with `columns` columns, and without what a separator at its end adds.
    pub(super) fn cells_of_row(self, line: &str, columns: usize) -> Vec<String> {
        let mut cells = self.split(line);
        if cells.len() == columns + 1 && cells.last().is_some_and(String::is_empty) {
            cells.pop();
        }
        cells
    }

    /// The cells of a line, without quotes.
    fn split(self, line: &str) -> Vec<String> {
        let cell = |cell: &str| cell.trim().trim_matches('"').trim().to_owned();
        let split = |separator: char| line.split(separator).map(cell).collect();
        match self {
            // Tables by hand may have a tab in the line of names only.
            Self::Tab if line.contains('\t') => split('\t'),
            Self::Tab | Self::Blanks => line.split_whitespace().map(cell).collect(),
            Self::Semicolon => split(';'),
            Self::Comma => split(','),
        }
    }
}

/// A name without the unit in brackets or parentheses behind it.
pub(super) fn without_unit(name: &str) -> &str {
    let end = [" [", " (", "["].iter().filter_map(|open| name.find(open)).min();
    match end {
        Some(end) if name.ends_with([']', ')']) => name[..end].trim_end(),
        _ => name,
    }
}
