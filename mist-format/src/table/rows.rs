//! The rows of a column table in the sound dialect.
//!
//! Separators are white space, commas and semicolons; numbers may be quoted, and `#` begins a
//! comment like `;`. A text whose meaning is not certain is refused with its line.

use super::error::TableError;
use crate::dialect::TextDeviation;
use crate::number::{number_prefix, whole_number};

/// The rows of a table: the number of columns and the numbers, row by row.
pub(super) struct Rows {
    pub(super) columns: usize,
    pub(super) numbers: Vec<f64>,
}

/// The separators of a file.
#[derive(Clone, Copy, PartialEq)]
enum Separators {
    /// White space and commas; `;` begins a comment.
    BlanksAndCommas,
    /// Semicolons; a comma is decimal if no number has a point.
    Semicolons { decimal_comma: bool },
}

/// Reads the rows of `text`.
///
/// All lines up to the first one that consists of numbers are a header. A file may hold a second
/// table with the same abscissae under a heading for k, as refractiveindex.info exports n and k.
///
/// # Errors
/// No rows, numeric lines with fewer columns than the first, items that only begin with a number,
/// decimal commas that may be separators, and further tables.
pub(super) fn read_rows(text: &str) -> Result<Rows, TableError> {
    let separators = separators(text);
    let lines: Vec<Vec<String>> = text.lines().map(|line| items(line, separators)).collect();
    let Some(first) = first_row(&lines) else { return Err(TableError::NoData) };
    let columns = lines[first].len();
    let heading = lines[..first].iter().rev().find(|items| !items.is_empty());
    let mut rows = Rows { columns, numbers: Vec::new() };
    // Rows with a remark behind their numbers are not headings.
    let has_all =
        |items: &&Vec<String>| items.iter().map_while(|item| whole_number(item)).count() == columns;
    for line in lines[..first].iter().filter(has_all) {
        rows.numbers.extend(line.iter().map_while(|item| whole_number(item)));
    }
    for (index, line) in lines.iter().enumerate().skip(first) {
        check_decimal_comma(index + 1, line)?;
        if is_second_heading(line, heading) {
            return with_second_table(rows, &lines, index);
        }
        rows.add(index + 1, first + 1, line)?;
    }
    rows.check_abscissae(text, first + 1)?;
    Ok(rows)
}

impl Rows {
    /// Adds a line: nothing if it does not begin with a number.
    fn add(&mut self, line: usize, first: usize, items: &[String]) -> Result<(), TableError> {
        let starts = items.iter().map_while(|item| number_prefix(item.as_bytes()).value).count();
        if starts == 0 {
            return Ok(());
        }
        let row = &items[..starts.min(self.columns)];
        if let Some(item) = row.iter().find(|item| whole_number(item).is_none()) {
            let (item, deviation) = (item.clone(), TextDeviation::NumberPrefix);
            return Err(TableError::Refused { line, item, deviation });
        }
        if starts < self.columns {
            return Err(TableError::ShortRow {
                line,
                found: starts,
                expected: self.columns,
                first,
            });
        }
        self.numbers.extend(row.iter().filter_map(|item| whole_number(item)));
        Ok(())
    }

    fn abscissae(&self) -> impl Iterator<Item = f64> {
        self.numbers.chunks_exact(self.columns).map(|row| row[0])
    }

    /// Whole numbers with commas whose first column repeats are halves of decimal numbers.
    fn check_abscissae(&self, text: &str, line: usize) -> Result<(), TableError> {
        let whole = self.numbers.iter().all(|x| x.fract() == 0.0);
        let repeats = self.abscissae().zip(self.abscissae().skip(1)).any(|(a, b)| a == b);
        if whole
            && repeats
            && self.columns >= 4
            && self.columns.is_multiple_of(2)
            && text.contains(',')
        {
            let item = text.lines().nth(line - 1).unwrap_or_default().trim().to_owned();
            return Err(TableError::DecimalComma { line, item });
        }
        Ok(())
    }
}

/// The index of the first line of numbers. A line whose items only begin with numbers is a heading
/// if the next line of numbers has another number of items.
fn first_row(lines: &[Vec<String>]) -> Option<usize> {
    let begins = |items: &[String]| {
        !items.is_empty() && items.iter().all(|i| number_prefix(i.as_bytes()).value.is_some())
    };
    let is_whole = |items: &[String]| items.iter().all(|item| whole_number(item).is_some());
    (0..lines.len()).find(|&at| {
        let next = || lines[at + 1..].iter().find(|items| begins(items) && is_whole(items));
        begins(&lines[at])
            && (is_whole(&lines[at]) || next().is_none_or(|next| next.len() == lines[at].len()))
    })
}

/// True if a line repeats the first name of the heading: a second table begins.
fn is_second_heading(items: &[String], heading: Option<&Vec<String>>) -> bool {
    let first = |items: &[String]| items.first().map(|item| item.to_lowercase());
    let name = first(items);
    name.is_some() && heading.is_some_and(|heading| first(heading) == name)
}

/// Adds the column of the second table, k over the abscissae of the first.
fn with_second_table(
    rows: Rows,
    lines: &[Vec<String>],
    heading: usize,
) -> Result<Rows, TableError> {
    let refused = TableError::SecondTable { line: heading + 1 };
    let is_k = |name: &String| name.to_lowercase().starts_with('k');
    if rows.columns != 2 || lines[heading].len() != 2 || !is_k(&lines[heading][1]) {
        return Err(refused);
    }
    let mut second = Rows { columns: 2, numbers: Vec::new() };
    for (index, line) in lines.iter().enumerate().skip(heading + 1) {
        second.add(index + 1, heading + 2, line)?;
    }
    if !rows.abscissae().eq(second.abscissae()) {
        return Err(refused);
    }
    let pairs = rows.numbers.chunks_exact(2).zip(second.numbers.chunks_exact(2));
    let numbers = pairs.flat_map(|(n, k)| [n[0], n[1], k[1]]).collect();
    Ok(Rows { columns: 3, numbers })
}

/// The separators of a file: semicolons if every line that begins with a number is a list of single
/// numbers between them.
fn separators(text: &str) -> Separators {
    let is_data = |line: &&str| {
        let line = line.trim_start_matches(['"', ' ', '\t']);
        number_prefix(line.as_bytes()).value.is_some()
    };
    let data: Vec<&str> = text.lines().filter(is_data).collect();
    let decimal_comma = !data.iter().any(|line| line.contains('.'));
    let found = Separators::Semicolons { decimal_comma };
    let is_list = |line: &&str| {
        let items = items(line, found);
        items.len() > 1 && items.iter().all(|item| whole_number(item).is_some())
    };
    let all = !data.is_empty() && data.iter().all(is_list);
    if all { found } else { Separators::BlanksAndCommas }
}

/// The items of a line without quotes and comments.
fn items(line: &str, separators: Separators) -> Vec<String> {
    let unquoted = |item: &str| item.trim().trim_matches('"').trim().to_owned();
    let line = line.trim_start_matches('\u{feff}');
    let mut found: Vec<String> = match separators {
        Separators::Semicolons { decimal_comma } => {
            let item = |item: &str| match decimal_comma {
                true => unquoted(item).replacen(',', ".", 1),
                false => unquoted(item),
            };
            line.split(';').map(item).collect()
        }
        Separators::BlanksAndCommas => {
            let code = without_comment(line).trim();
            let pure_list = !code.contains([' ', '\t']);
            let blanks = code.split([' ', '\t']).filter(|block| !block.is_empty());
            let spaced_list = blanks.clone().any(|block| block.ends_with(','));
            let split = |block: &str| pure_list || spaced_list || is_list_with_points(block);
            blanks
                .flat_map(|block| {
                    let block = block.trim_matches(',');
                    let parts: Vec<&str> =
                        if split(block) { block.split(',').collect() } else { vec![block] };
                    parts.into_iter().map(unquoted).collect::<Vec<_>>()
                })
                .collect()
        }
    };
    while found.last().is_some_and(String::is_empty) {
        found.pop();
    }
    found
}

/// True if the parts between commas all have decimal points.
fn is_list_with_points(block: &str) -> bool {
    block.contains(',') && block.split(',').all(|part| part.contains('.'))
}

/// The line up to `;`, or to a `#` that begins a word.
fn without_comment(line: &str) -> &str {
    let begins_word = |at: usize| line[..at].ends_with([' ', '\t']) || at == 0;
    let end = line.char_indices().find(|(at, c)| *c == ';' || *c == '#' && begins_word(*at));
    &line[..end.map_or(line.len(), |(at, _)| at)]
}

/// Refuses items such as `0,45` in lines with other separators.
fn check_decimal_comma(line: usize, items: &[String]) -> Result<(), TableError> {
    let is_decimal = |item: &&String| {
        let parts: Vec<&str> = item.split(',').collect();
        parts.len() == 2 && parts.iter().all(|part| whole_number(part).is_some())
    };
    match items.iter().find(is_decimal) {
        Some(item) => Err(TableError::DecimalComma { line, item: item.clone() }),
        None => Ok(()),
    }
}
