//! Tables of numbers in columns; the first column is the abscissa.

use super::error::TableError;
use super::lines::{lines, open_comment};
use super::rows::read_rows;
use crate::dialect::Dialect;
use crate::number::number_prefix;

/// A table of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnTable {
    columns: usize,
    /// Row after row, as in the file.
    numbers: Vec<f64>,
    /// For each column from the second on, its points sorted by (x, y).
    points: Vec<Vec<(f64, f64)>>,
}

impl ColumnTable {
    /// Reads a table.
    ///
    /// All lines up to the first one that consists of numbers are a header. That line gives
    /// the number of columns; lines that do not begin with a number are skipped.
    ///
    /// Compat: columns are separated by white space, a comma may follow a number; an item counts
    /// as a number if it begins with one, lines with fewer numbers are skipped, and the last line
    /// is dropped if it has no line end. Sound: the module `rows` has the rules.
    ///
    /// # Errors
    /// An empty file, no row of numbers, an open comment, and texts that the sound dialect refuses.
    pub fn parse(text: &str, dialect: Dialect) -> Result<Self, TableError> {
        if text.trim().is_empty() {
            return Err(TableError::Empty);
        }
        if let Some(line) = open_comment(text) {
            return Err(TableError::OpenComment { line });
        }
        if dialect.is_compat() {
            return nist_rows(text);
        }
        let rows = read_rows(text)?;
        Ok(Self::from_rows(rows.columns, rows.numbers))
    }

    /// A table of rows of `columns` numbers each, one row after the other; numbers that fill
    /// no row are dropped.
    pub fn from_rows(columns: usize, mut numbers: Vec<f64>) -> Self {
        let columns = columns.max(1);
        numbers.truncate(numbers.len() / columns * columns);
        let column = |c: usize| {
            let mut points: Vec<_> =
                numbers.chunks_exact(columns).map(|row| (row[0], row[c])).collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
            points
        };
        let points = (1..columns).map(column).collect();
        Self { columns, numbers, points }
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The rows in the order of the file.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.numbers.chunks_exact(self.columns)
    }

    /// The points (x, y) of a column, from 2 on, sorted by x, equal ones by y.
    ///
    /// # Errors
    /// There is no such column.
    pub fn points(&self, column: i64) -> Result<&[(f64, f64)], TableError> {
        let place = usize::try_from(column).ok().and_then(|column| column.checked_sub(2));
        let points = place.and_then(|place| self.points.get(place));
        let columns = Some(self.columns);
        points.map(Vec::as_slice).ok_or(TableError::MissingColumn { column, columns })
    }

    /// The value of a column at `x`: linear between the points, constant outside of them.
    ///
    /// Column 1 is `x` itself, kept in the range. Where several points share an x, the last
    /// one counts for what is at and to the right of it; but the x of the first row of the
    /// *file* always gives that row's value.
    ///
    /// # Errors
    /// There is no such column.
    pub fn look_up(&self, x: f64, column: i64) -> Result<f64, TableError> {
        if column == 1 {
            let xs = || self.numbers.chunks_exact(self.columns).map(|row| row[0]);
            let low = xs().fold(f64::INFINITY, f64::min);
            let high = xs().fold(f64::NEG_INFINITY, f64::max);
            return Ok(if low <= high { x.max(low).min(high) } else { x });
        }
        let points = self.points(column)?;
        let row = self.rows().next().filter(|row| row[0] == x);
        if let Some(y) = row.and_then(|row| row.get(column as usize - 1)) {
            return Ok(*y);
        }
        Ok(interpolate(points, x))
    }
}

/// The rows as NIST's program reads them.
fn nist_rows(text: &str) -> Result<ColumnTable, TableError> {
    let mut columns = 0;
    let mut numbers = Vec::new();
    for line in lines(text).take_while(|line| line.ended) {
        let items = || line.text.split_ascii_whitespace();
        if columns == 0 {
            if items().next().is_none() || !items().all(|item| leading(item).is_some()) {
                continue;
            }
            columns = items().count();
        }
        let before = numbers.len();
        numbers.extend(items().map_while(leading).take(columns));
        if numbers.len() < before + columns {
            numbers.truncate(before);
        }
    }
    if columns == 0 || numbers.is_empty() {
        return Err(TableError::NoData);
    }
    Ok(ColumnTable::from_rows(columns, numbers))
}

/// Linear between sorted points, constant outside of them; NaN without points.
fn interpolate(points: &[(f64, f64)], x: f64) -> f64 {
    let behind = points.partition_point(|point| point.0 <= x);
    match (points.get(behind.wrapping_sub(1)), points.get(behind)) {
        (Some(&(x0, y0)), Some(&(x1, y1))) => y0 + (x - x0) / (x1 - x0) * (y1 - y0),
        (Some(only), None) | (None, Some(only)) => only.1,
        (None, None) => f64::NAN,
    }
}

/// The number that an item begins with.
fn leading(item: &str) -> Option<f64> {
    number_prefix(item.as_bytes()).value
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "x y1 y2 ; header\n\n0 1 5\n1 1.218 6 ; comment\n 3 10 20 extra\n2 7 8\nbad row\n4 4\n5 -1 0.5\n";

    fn compat(text: &str) -> ColumnTable {
        ColumnTable::parse(text, Dialect::Compat).unwrap()
    }

    // The expected values are NIST's, printed with 17 digits.
    #[test]
    fn look_ups_give_nists_values() {
        let table = compat(TEXT);
        for (x, column, y) in [
            (0.05, 2, 1.0108999999999999),
            (3.9, 2, 5.0500000000000007),
            (4.25, 3, 7.8125),
            (-9.0, 2, 1.0),
            (99.0, 3, 0.5),
            (-1.0, 1, 0.0),
            (1.1, 1, 1.1),
        ] {
            // One rounding more or less in x.
            assert!((table.look_up(x, column).unwrap() - y).abs() < 1e-14, "{x} {column}");
        }
    }

    #[test]
    fn of_equal_abscissae_the_later_counts_unless_it_is_the_first_row() {
        let table = compat("0 1\n1 2\n1 5\n2 6\n");
        assert_eq!(table.look_up(1.0, 2), Ok(5.0));
        assert_eq!(table.look_up(0.75, 2), Ok(1.75));
        let table = compat("1 2\n1 5\n0 1\n");
        assert_eq!(table.look_up(1.0, 2), Ok(2.0));
    }

    #[test]
    fn a_last_line_without_an_end_is_dropped_by_nist_only() {
        let text = "0 1\n1 2\n2 5";
        assert_eq!(compat(text).rows().len(), 2);
        assert_eq!(ColumnTable::parse(text, Dialect::Sound).unwrap().rows().len(), 3);
    }

    #[test]
    fn a_comma_needs_a_blank_in_compat() {
        assert_eq!(compat("0.4, 1.5, 0\n").columns(), 3);
        let glued = "0.4,1.5,0\n";
        assert_eq!(compat(glued).columns(), 1);
        assert_eq!(ColumnTable::parse(glued, Dialect::Sound).unwrap().columns(), 3);
    }

    #[test]
    fn missing_columns_and_rows_are_reported() {
        let columns = Some(3);
        assert_eq!(
            compat(TEXT).look_up(1.0, 4),
            Err(TableError::MissingColumn { column: 4, columns })
        );
        assert!(compat(TEXT).look_up(1.0, i64::MIN).is_err());
        let parse = |text| ColumnTable::parse(text, Dialect::Sound);
        assert_eq!(parse(""), Err(TableError::Empty));
        assert_eq!(parse("a b\nc d\n"), Err(TableError::NoData));
        assert_eq!(parse("1 2\n3 4 ; x"), Err(TableError::OpenComment { line: 2 }));
    }
}
