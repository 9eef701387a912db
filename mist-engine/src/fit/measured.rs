//! A table of measured values: which lines of a program's results it is about, and what was
//! measured there.
//!
//! A line names the columns, like the results of the program: the first one that names an output.
//! Lines above it, blank lines and lines that begin with `#` do not count. Columns are separated by
//! tabs, else by semicolons, else by commas, else by blanks. Names may be quoted, and
//! units in brackets may follow them.
//!
//! | column | holds |
//! | --- | --- |
//! | the title of a loop | its value: which line of the results the row is about |
//! | the label of an output | the measured value; `nan` where there is none |
//! | `sigma(LABEL)` | its uncertainty σ > 0 |
//! | `sigma` | the uncertainty of every output of the row that has no column of its own |
//! | `weight` | 1/σ² in place of σ, ≥ 0; zero leaves the row out |
//!
//! A table without any column of a loop has a row for every line of the results, in its order.

use std::collections::BTreeMap;

use super::cells::{Separator, without_unit};
use crate::function::OutputRow;

/// Loop values are printed with six digits; nothing closer than this can be told apart.
const SAME: f64 = 2e-6;

/// Measured values of one row.
#[derive(Clone, Debug, PartialEq)]
pub struct Datum {
    /// Row of the table, from 1.
    pub row: usize,
    /// Output of the program.
    pub output: usize,
    /// The measured value.
    pub value: f64,
    /// Its uncertainty.
    pub sigma: f64,
}

/// A table of measured values.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredTable {
    /// The loops that have a column.
    loops: Vec<usize>,
    /// Values of those loops, row by row.
    places: Vec<Vec<String>>,
    data: Vec<Datum>,
    ignored: Vec<String>,
}

/// Error in a table of measured values.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeasuredError {
    /// There is no line with names.
    #[error("the measured table has no line that names its columns")]
    Empty,
    /// No column is an output.
    #[error(
        "no line of the measured table names an output of the program; its outputs are {outputs}, \
         and the first line has {found}"
    )]
    NoOutput {
        /// The outputs.
        outputs: String,
        /// The names in the first line.
        found: String,
    },
    /// A name stands twice.
    #[error("the measured table has two columns {0:?}")]
    Twice(String),
    /// A row has too few or too many cells.
    #[error("line {line}: {found} values for {expected} columns")]
    Width {
        /// Line of the file, from 1.
        line: usize,
        /// Values in the row.
        found: usize,
        /// Columns.
        expected: usize,
    },
    /// A cell cannot be used.
    #[error("line {line}, column {column:?}: {text:?} is not {expected}")]
    LoopCell {
        /// Line of the file, from 1.
        line: usize,
        /// Name of the column.
        column: String,
        /// Text that was found.
        text: String,
        /// Expected text.
        expected: &'static str,
    },
    /// Rows and lines of the results cannot be brought together.
    #[error(
        "the measured table has {rows} rows and no column of a loop, but the program gives \
         {lines} lines; add the columns {loops}"
    )]
    Count {
        /// Rows.
        rows: usize,
        /// Lines of the results.
        lines: usize,
        /// The loops.
        loops: String,
    },
    /// No line of the results, or more than one, has the loop values of a row.
    #[error("row {row} of the measured table ({place}): {found} lines of the results are there")]
    Place {
        /// Row, from 1.
        row: usize,
        /// Its loop values.
        place: String,
        /// Number of lines with these values.
        found: usize,
    },
}

/// Contents of a column.
#[derive(Clone, Copy, Debug, PartialEq)]
enum MeasuredColumn {
    Loop(usize),
    Output(usize),
    Sigma(usize),
    SigmaOfAll,
    Weight,
    Ignored,
}

impl MeasuredTable {
    /// Reads a table for a program whose results have the columns `loops` and `outputs` and the
    /// lines `headers` above them.
    ///
    /// # Errors
    ///
    /// See [`MeasuredError`].
    pub fn parse(
        text: &str,
        [loops, outputs]: &[Vec<String>; 2],
        headers: &[String],
    ) -> Result<Self, MeasuredError> {
        let text = text.trim_start_matches('\u{feff}');
        let lines: Vec<(usize, &str)> = (1..)
            .zip(text.lines())
            .filter(|(number, line)| {
                let header: Option<&String> = headers.get(number - 1);
                let is_header = header.is_some_and(|header| header.trim() == line.trim());
                !is_header && !line.trim().is_empty() && !line.starts_with('#')
            })
            .collect();
        let first = lines.first().ok_or(MeasuredError::Empty)?.1;
        let roles_of = |line: &str| {
            let names = Separator::of(line).cells(line);
            let roles = names.iter().map(|name| role(name, loops, outputs));
            roles.collect::<Vec<MeasuredColumn>>()
        };
        let names_output = |line: &str| {
            roles_of(line).iter().any(|role| matches!(role, MeasuredColumn::Output(_)))
        };
        let Some(heading) = lines.iter().position(|(_, line)| names_output(line)) else {
            let found = Separator::of(first).cells(first).join(", ");
            return Err(MeasuredError::NoOutput { outputs: outputs.join(", "), found });
        };
        let (separator, roles) = (Separator::of(lines[heading].1), roles_of(lines[heading].1));
        let names = separator.cells(lines[heading].1);
        for (at, name) in names.iter().enumerate() {
            if roles[at] != MeasuredColumn::Ignored && names[..at].contains(name) {
                return Err(MeasuredError::Twice(name.clone()));
            }
        }
        let mut table = Self {
            loops: roles.iter().filter_map(|role| role.of_loop()).collect(),
            places: Vec::new(),
            data: Vec::new(),
            ignored: names_of(&names, &roles, MeasuredColumn::Ignored),
        };
        let rows = &lines[heading + 1..];
        // Points of other columns than commas separate are decimal, and so are their commas.
        let has_points = rows.iter().any(|(_, text)| text.contains('.'));
        let decimal_comma = separator != Separator::Comma && !has_points;
        for &(line, text) in rows {
            let mut cells = separator.cells_of_row(text, names.len());
            if decimal_comma {
                cells.iter_mut().for_each(|cell| *cell = cell.replacen(',', ".", 1));
            }
            if cells.len() != names.len() {
                let (found, expected) = (cells.len(), names.len());
                return Err(MeasuredError::Width { line, found, expected });
            }
            table.add(line, &cells, &names, &roles)?;
        }
        Ok(table)
    }

    /// The data.
    pub fn data(&self) -> &[Datum] {
        &self.data
    }

    /// Names of columns that mean nothing here.
    pub fn ignored(&self) -> &[String] {
        &self.ignored
    }

    fn add(
        &mut self,
        line: usize,
        cells: &[String],
        names: &[String],
        roles: &[MeasuredColumn],
    ) -> Result<(), MeasuredError> {
        let row = self.places.len() + 1;
        let number = |at: usize, expected, good: fn(f64) -> bool| {
            // An empty cell is a missing value.
            let text = if cells[at].is_empty() { "nan" } else { &cells[at] };
            let value = text.parse().ok().filter(|value| good(*value));
            value.ok_or_else(|| MeasuredError::LoopCell {
                line,
                column: names[at].clone(),
                text: cells[at].clone(),
                expected,
            })
        };
        let mut place = Vec::new();
        let mut values = Vec::new();
        let mut sigmas = BTreeMap::new();
        let mut common = 1.0;
        for (at, role) in roles.iter().enumerate() {
            match role {
                MeasuredColumn::Loop(_) => place.push(cells[at].clone()),
                MeasuredColumn::Output(output) => {
                    let value = number(at, "a number", |v| v.is_nan() || v.is_finite())?;
                    values.push((*output, value));
                }
                MeasuredColumn::Sigma(output) => {
                    let sigma = number(at, "a positive number", |v| v > 0.0 && v.is_finite())?;
                    sigmas.insert(*output, sigma);
                }
                MeasuredColumn::SigmaOfAll => {
                    common = number(at, "a positive number", |v| v > 0.0 && v.is_finite())?;
                }
                MeasuredColumn::Weight => {
                    let weight = number(at, "zero or a positive number", |v| v >= 0.0)?;
                    common = 1.0 / f64::sqrt(weight);
                }
                MeasuredColumn::Ignored => {}
            }
        }
        for (output, value) in values.into_iter().filter(|(_, value)| !value.is_nan()) {
            let sigma = sigmas.get(&output).copied().unwrap_or(common);
            if sigma.is_finite() {
                self.data.push(Datum { row, output, value, sigma });
            }
        }
        self.places.push(place);
        Ok(())
    }

    /// For every datum the line of the results that it is about.
    ///
    /// # Errors
    ///
    /// If rows and lines cannot be brought together.
    pub(super) fn locate(
        &self,
        rows: &[OutputRow],
        titles: &[String],
    ) -> Result<Vec<usize>, MeasuredError> {
        if self.loops.is_empty() {
            if self.places.len() != rows.len() {
                let (found, lines) = (self.places.len(), rows.len());
                let loops = titles.join(", ");
                return Err(MeasuredError::Count { rows: found, lines, loops });
            }
            return Ok(self.data.iter().map(|datum| datum.row - 1).collect());
        }
        let line = |(at, place): (usize, &Vec<String>)| {
            let here = |row: &&OutputRow| {
                self.loops.iter().zip(place).all(|(each, cell)| same(&row.loops[*each], cell))
            };
            let found = rows.iter().filter(here).count();
            match rows.iter().position(|row| here(&row)) {
                Some(line) if found == 1 => Ok(line),
                _ => {
                    let named = self.loops.iter().zip(place);
                    let named = named.map(|(each, cell)| format!("{} = {cell}", titles[*each]));
                    let place = named.collect::<Vec<_>>().join(", ");
                    Err(MeasuredError::Place { row: at + 1, place, found })
                }
            }
        };
        let lines = self.places.iter().enumerate().map(line);
        let lines: Vec<usize> = lines.collect::<Result<_, _>>()?;
        Ok(self.data.iter().map(|datum| lines[datum.row - 1]).collect())
    }
}

impl MeasuredColumn {
    fn of_loop(self) -> Option<usize> {
        match self {
            Self::Loop(at) => Some(at),
            _ => None,
        }
    }
}

fn role(name: &str, loops: &[String], outputs: &[String]) -> MeasuredColumn {
    let exact = |list: &[String], name: &str| list.iter().position(|each| each == name);
    let bare = |list: &[String], name: &str| {
        list.iter().position(|each| each.eq_ignore_ascii_case(without_unit(name)))
    };
    let find = |list: &[String], name: &str| exact(list, name).or_else(|| bare(list, name));
    let inner = name.strip_prefix("sigma(").and_then(|rest| rest.strip_suffix(')'));
    if let Some(at) = find(outputs, name) {
        MeasuredColumn::Output(at)
    } else if let Some(at) = find(loops, name) {
        MeasuredColumn::Loop(at)
    } else if let Some(at) = inner.and_then(|label| find(outputs, label)) {
        MeasuredColumn::Sigma(at)
    } else {
        match without_unit(name) {
            "sigma" => MeasuredColumn::SigmaOfAll,
            "weight" => MeasuredColumn::Weight,
            _ => MeasuredColumn::Ignored,
        }
    }
}

fn names_of(names: &[String], roles: &[MeasuredColumn], wanted: MeasuredColumn) -> Vec<String> {
    names.iter().zip(roles).filter(|(_, role)| **role == wanted).map(|(n, _)| n.clone()).collect()
}

/// True if a cell of the results and one of the table are the same loop value.
fn same(line: &str, cell: &str) -> bool {
    match (line.trim().parse::<f64>(), cell.parse::<f64>()) {
        (Ok(a), Ok(b)) => (a - b).abs() <= SAME * a.abs().max(b.abs()),
        _ => line.trim() == cell,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn titles() -> [Vec<String>; 2] {
        [vec!["angle".into()], vec!["R".into(), "the sum".into()]]
    }

    fn rows() -> Vec<OutputRow> {
        [0.1, 0.2, 0.3]
            .map(|a: f64| OutputRow { loops: vec![a.to_string()], outputs: vec![] })
            .into()
    }

    #[test]
    fn results_of_the_program_are_a_table() {
        let headers = ["A title, with a comma".to_owned()];
        let text = "A title, with a comma\nangle\tR\tthe sum\t\n0.1\t  1\t  2\t\n0.2\t3\t nan\t\n";
        let table = MeasuredTable::parse(text, &titles(), &headers).unwrap();
        let values: Vec<_> = table.data().iter().map(|d| (d.row, d.output, d.value)).collect();
        assert_eq!(values, [(1, 0, 1.0), (1, 1, 2.0), (2, 0, 3.0)]);
        assert_eq!(table.locate(&rows(), &titles()[0]).unwrap(), [0, 0, 1]);
    }

    #[test]
    fn rows_may_stand_in_any_order_and_have_uncertainties() {
        let text = "# by hand\nR,angle,sigma(R),note\n5,0.3000001,0.5,x\n4,0.1,0.25,y\n";
        let table = MeasuredTable::parse(text, &titles(), &[]).unwrap();
        assert_eq!(table.locate(&rows(), &titles()[0]).unwrap(), [2, 0]);
        assert_eq!(table.data()[1].sigma, 0.25);
        assert_eq!(table.ignored(), ["note"]);
        let text = "R weight\n1 4\n2 0\n3 1\n";
        let table = MeasuredTable::parse(text, &titles(), &[]).unwrap();
        let sigmas: Vec<_> = table.data().iter().map(|d| (d.row, d.sigma)).collect();
        assert_eq!(sigmas, [(1, 0.5), (3, 1.0)]);
        assert_eq!(table.locate(&rows(), &titles()[0]).unwrap(), [0, 2]);
    }

    #[test]
    fn headings_of_instruments_are_read() {
        for text in [
            "\"angle\",\"R\"\n0.1,4\n0.2,5.5\n",
            "angle;R\n0,1;4\n0,2;5,5\n",
            "angle\tR\n0,1\t4\n0,2\t5,5\n",
            "angle [deg],R [1/sr]\n0.1,4\n0.2,5.5\n",
            "Angle (deg);r\n0.1;4\n0.2;5.5\n",
            "Instrument: X\nDate: 2024-01-01, noon\nangle,R,\n0.1,4,\n0.2,5.5,\n",
        ] {
            let table = MeasuredTable::parse(text, &titles(), &[]).unwrap();
            let values: Vec<f64> = table.data().iter().map(|datum| datum.value).collect();
            assert_eq!(values, [4.0, 5.5], "{text}");
            assert_eq!(table.locate(&rows(), &titles()[0]).unwrap(), [0, 1], "{text}");
        }
    }

    #[test]
    fn tables_that_do_not_fit_are_refused() {
        let parse = |text| MeasuredTable::parse(text, &titles(), &[]);
        assert_eq!(parse(" \n"), Err(MeasuredError::Empty));
        assert!(matches!(parse("angle\n1\n"), Err(MeasuredError::NoOutput { .. })));
        assert!(matches!(parse("R R\n1 1\n"), Err(MeasuredError::Twice(_))));
        assert!(matches!(parse("R angle\n1\n"), Err(MeasuredError::Width { line: 2, .. })));
        assert!(matches!(parse("R\n1x5\n"), Err(MeasuredError::LoopCell { line: 2, .. })));
        assert!(matches!(parse("R sigma\n1 0\n"), Err(MeasuredError::LoopCell { line: 2, .. })));
        let locate = |text| parse(text).unwrap().locate(&rows(), &titles()[0]);
        assert!(matches!(locate("R\n1\n"), Err(MeasuredError::Count { .. })));
        let far = locate("R angle\n1 0.4\n");
        assert!(matches!(far, Err(MeasuredError::Place { found: 0, .. })));
    }
}
