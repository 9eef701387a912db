//! Common parts of `.mtab` and `.mspd`: header lines, columns, rows, checksum.

use std::str::FromStr;

use super::error::ReadError;
use crate::write::{MAGIC, checksum};

/// The parts of a text table, after comparison of the number of rows and the checksum.
#[derive(Debug)]
pub(super) struct TextTable<'a> {
    /// Header lines in their order, `columns` excepted.
    header: Vec<HeaderLine<'a>>,
    /// Names of the columns.
    pub(super) columns: Vec<&'a str>,
    /// One number per column in each row.
    pub(super) rows: Vec<Vec<f64>>,
}

/// One header line.
#[derive(Clone, Copy, Debug)]
pub(super) struct HeaderLine<'a> {
    number: usize,
    key: &'a str,
    /// The text after the key.
    pub(super) value: &'a str,
}

impl<'a> HeaderLine<'a> {
    /// An error at this line.
    pub(super) fn error(&self, problem: impl Into<String>) -> ReadError {
        ReadError::Header { line: self.number, key: self.key.into(), problem: problem.into() }
    }

    /// The blank-separated words of the value.
    pub(super) fn words(&self) -> impl Iterator<Item = &'a str> + use<'a> {
        self.value.split_ascii_whitespace()
    }

    /// `word` as a number of this line.
    pub(super) fn parse<T: FromStr>(&self, word: &str) -> Result<T, ReadError> {
        word.parse().map_err(|_| self.error(format!("{word:?} is not a number")))
    }

    /// All words as numbers, which must be `N`.
    pub(super) fn numbers<const N: usize>(&self) -> Result<[f64; N], ReadError> {
        let list = self.words().map(|word| self.parse(word)).collect::<Result<Vec<f64>, _>>()?;
        list.try_into().map_err(|_| self.error(format!("{N} numbers are expected")))
    }
}

impl<'a> TextTable<'a> {
    /// Takes `text` apart.
    ///
    /// # Errors
    ///
    /// For everything that does not depend on the meaning of keys and columns.
    pub(super) fn parse(text: &'a str) -> Result<Self, ReadError> {
        let mut table = Self { header: Vec::new(), columns: Vec::new(), rows: Vec::new() };
        let mut rows_text = None;
        let mut at = 0;
        let mut ended = false;
        for (i, line) in text.split_inclusive('\n').enumerate() {
            let number = i + 1;
            let start = at;
            at += line.len();
            let line = line.trim_end_matches(['\n', '\r']);
            no_control(number, line)?;
            match line.strip_prefix('#') {
                _ if ended && !line.is_empty() => return Err(ReadError::AfterEnd(number)),
                _ if ended => {}
                Some(rest) if i == 0 && rest.trim() == MAGIC => {}
                _ if i == 0 => return Err(ReadError::NotATable),
                Some(rest) => {
                    let (key, value) = split_key(rest);
                    match key {
                        "end" => {
                            let rows = &text[rows_text.unwrap_or(start)..start];
                            table.check_end(HeaderLine { number, key, value }, rows)?;
                            ended = true;
                        }
                        _ if rows_text.is_some() => return Err(ReadError::LateHeader(number)),
                        "columns" => table.columns = value.split_ascii_whitespace().collect(),
                        _ => table.header.push(HeaderLine { number, key, value }),
                    }
                }
                None => {
                    rows_text.get_or_insert(start);
                    table.push_row(number, line)?;
                }
            }
        }
        match (text.is_empty(), ended) {
            (true, _) => Err(ReadError::NotATable),
            (_, false) => Err(ReadError::Truncated(table.rows.len())),
            (_, true) => Ok(table),
        }
    }

    fn push_row(&mut self, number: usize, line: &str) -> Result<(), ReadError> {
        if self.columns.is_empty() {
            return Err(ReadError::Missing("columns"));
        }
        let expected = self.columns.len();
        let found = line.split_ascii_whitespace().count();
        if found != expected {
            return Err(ReadError::Width { line: number, found, expected });
        }
        let row = line.split_ascii_whitespace().zip(&self.columns).map(|(word, column)| {
            word.parse().ok().filter(|x: &f64| x.is_finite()).ok_or_else(|| ReadError::Number {
                line: number,
                column: (*column).into(),
                text: word.into(),
            })
        });
        self.rows.push(row.collect::<Result<_, _>>()?);
        Ok(())
    }

    fn check_end(&self, end: HeaderLine<'_>, rows: &str) -> Result<(), ReadError> {
        let mut words = end.words();
        let (Some(count), Some(stated), None) = (words.next(), words.next(), words.next()) else {
            return Err(end.error("the number of rows and their checksum belong here"));
        };
        self.check_count(end.parse(count)?, "\"# end\"")?;
        let found = checksum(rows.as_bytes());
        if found != stated {
            return Err(ReadError::Checksum { found, stated: stated.into() });
        }
        Ok(())
    }

    /// An error unless there are `stated` rows.
    pub(super) fn check_count(&self, stated: usize, by: &'static str) -> Result<(), ReadError> {
        let found = self.rows.len();
        if found == stated { Ok(()) } else { Err(ReadError::RowCount { found, stated, by }) }
    }

    /// The lines with this key.
    pub(super) fn lines<'s>(&'s self, key: &'s str) -> impl Iterator<Item = HeaderLine<'a>> + 's {
        self.header.iter().copied().filter(move |line| line.key == key)
    }

    /// The line with this key.
    ///
    /// # Errors
    ///
    /// If there is none.
    pub(super) fn line(&self, key: &'static str) -> Result<HeaderLine<'a>, ReadError> {
        self.lines(key).next().ok_or(ReadError::Missing(key))
    }

    /// The value with this key as text.
    pub(super) fn owned(&self, key: &'static str) -> Result<String, ReadError> {
        Ok(self.line(key)?.value.to_owned())
    }

    /// The index of the column `name`.
    ///
    /// # Errors
    ///
    /// If there is none.
    pub(super) fn column(&self, name: &str) -> Result<usize, ReadError> {
        self.columns.iter().position(|column| *column == name).ok_or_else(|| ReadError::Header {
            line: 0,
            key: "columns".into(),
            problem: format!("there is no column {name}"),
        })
    }
}

/// An error if `line` has another control character than a tab.
fn no_control(number: usize, line: &str) -> Result<(), ReadError> {
    match line.chars().enumerate().find(|(_, c)| c.is_control() && *c != '\t') {
        Some((i, found)) => Err(ReadError::Control { line: number, column: i + 1, found }),
        None => Ok(()),
    }
}

/// The first word after `#`, and the rest.
fn split_key(rest: &str) -> (&str, &str) {
    let rest = rest.trim();
    let (key, value) = rest.split_once(' ').unwrap_or((rest, ""));
    (key, value.trim())
}
