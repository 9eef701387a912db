//! Colours for a table of results that a MIST program wrote.

use std::collections::HashMap;

use mist_format::{number::whole_number, suggestion::did_you_mean};
use spectra::{ColourSettings, wavelength::nm_from_um};

use super::{
    MaterialError,
    table::{Colours, TableHead},
};
use crate::colour::{ColourTable, RowOrder, RowPatch, fold::coloured};

/// Which columns of a results file make spectra.
#[derive(Clone, Debug, PartialEq)]
pub struct ResultColumns {
    /// The column of the wavelength.
    pub wavelength: String,
    /// True if it is in nm; else it is in µm.
    pub nm: bool,
    /// One column, or four for I, Q, U and V.
    pub values: Vec<String>,
}

impl ResultColumns {
    /// From `wl:nm` (or `wl:um`, the same as `wl`) and `f0,f1,f2,f3`.
    ///
    /// # Errors
    ///
    /// For other units and numbers of columns.
    pub fn parse(wavelength: &str, values: &str) -> Result<Self, MaterialError> {
        let (name, unit) = wavelength.split_once(':').unwrap_or((wavelength, "um"));
        let nm = match unit {
            "nm" => true,
            "um" => false,
            _ => {
                let problem = format!("unit {unit:?} is none of nm and um");
                return Err(MaterialError::request("wavelength", problem));
            }
        };
        let values: Vec<String> = values.split(',').map(|name| name.trim().to_owned()).collect();
        if values.len() != 1 && values.len() != 4 {
            let problem = format!("expected one column or four, not {}", values.len());
            return Err(MaterialError::request("value", problem));
        }
        Ok(Self { wavelength: name.trim().to_owned(), nm, values })
    }
}

/// One spectrum while it grows.
struct GroupedRow {
    leading: Vec<f64>,
    direction: [f64; 4],
    samples: Vec<(f64, [f64; 4])>,
}

/// The colour table of `text`, the results file of a program: header lines, a line of names
/// separated by tabs, and rows of numbers.
///
/// Rows belong to one spectrum that agree in the columns before the first value. Of these,
/// `thetai`, `thetas`, `phis` and `alpha` (degrees) and `omega` (sr) are known by their names;
/// others lead the rows of the table.
///
/// # Errors
///
/// For columns that are missing, cells that are not numbers, and spectra with different or
/// unusable wavelengths.
pub fn table(
    text: &str,
    columns: &ResultColumns,
    material: &str,
    settings: &ColourSettings,
    (incident, frame): ([f64; 4], &'static str),
) -> Result<ColourTable, MaterialError> {
    let (start, names) = names(text, columns)?;
    let at = |name: &str| names.iter().position(|this| *this == name);
    let missing = "the line of names has it";
    let wavelength = at(&columns.wavelength).expect(missing);
    let values: Vec<usize> = columns.values.iter().map(|name| at(name).expect(missing)).collect();
    let angles = ["thetai", "thetas", "phis", "omega"].map(at);
    let first = values.iter().copied().min().unwrap_or_default();
    let keys: Vec<usize> = (0..first).filter(|column| *column != wavelength).collect();
    let alpha = at("alpha").filter(|column| keys.contains(column));

    let mut rows: Vec<GroupedRow> = Vec::new();
    let mut places: HashMap<Vec<&str>, usize> = HashMap::new();
    let others: Vec<usize> =
        keys.iter().copied().filter(|column| !angles.contains(&Some(*column))).collect();
    for (number, line) in text.lines().enumerate().skip(start).filter(|(_, l)| !l.trim().is_empty())
    {
        let row =
            ResultRow { number: number + 1, cells: line.split('\t').map(str::trim).collect() };
        let key: Vec<&str> = keys.iter().map(|column| row.text(*column)).collect();
        let place = match places.get(&key) {
            Some(place) => *place,
            None => {
                let mut direction = [0.0; 4];
                for (value, column) in direction.iter_mut().zip(angles) {
                    *value = column.map_or(Ok(0.0), |column| row.number(column))?;
                }
                let leading = others.iter().map(|column| row.number(*column));
                let leading = leading.collect::<Result<_, _>>()?;
                rows.push(GroupedRow { leading, direction, samples: Vec::new() });
                places.insert(key, rows.len() - 1);
                rows.len() - 1
            }
        };
        let x = row.number(wavelength)?;
        let mut stokes = [0.0; 4];
        for (value, column) in stokes.iter_mut().zip(&values) {
            *value = row.number(*column)?;
        }
        rows[place].samples.push((if columns.nm { x } else { nm_from_um(x) }, stokes));
    }
    rows.iter_mut().for_each(|row| row.samples.sort_by(|a, b| a.0.total_cmp(&b.0)));
    let nm = |row: &GroupedRow| row.samples.iter().map(|sample| sample.0).collect::<Vec<f64>>();
    let wavelengths = rows.first().map(nm).unwrap_or_default();
    if let Some(odd) = rows.iter().position(|row| nm(row) != wavelengths) {
        let problem = format!("spectrum {} has other wavelengths than the first one", odd + 1);
        return Err(MaterialError::request("wavelength", problem));
    }

    let mut leading: Vec<String> = others.iter().map(|column| names[*column].to_owned()).collect();
    let patch = constant_alpha(alpha, &others, &mut leading, &mut rows);
    let colours = Colours::new(&wavelengths, settings)?;
    let rows: Vec<_> = rows
        .into_iter()
        .map(|row| {
            let mut spectra: [Vec<f64>; 4] = Default::default();
            for (component, spectrum) in spectra.iter_mut().enumerate().take(values.len()) {
                *spectrum = row.samples.iter().map(|(_, stokes)| stokes[component]).collect();
            }
            coloured(&colours.plan, row.leading, row.direction, spectra, 0)
        })
        .collect();
    let dark = rows.iter().all(|row| row.spectra[3].iter().all(|v| *v == 0.0));
    let stokes = if values.len() == 4 && dark { 3 } else { values.len() };
    let (material, layout) = (material.to_owned(), RowOrder::List);
    Ok(colours.table(
        TableHead { material, incident, frame, layout, patch, leading, stokes },
        rows,
        Vec::new(),
    ))
}

/// One `alpha` for all rows is the patch of the table, and no column of it.
fn constant_alpha(
    alpha: Option<usize>,
    others: &[usize],
    leading: &mut Vec<String>,
    rows: &mut [GroupedRow],
) -> RowPatch {
    let place = alpha.and_then(|alpha| others.iter().position(|column| *column == alpha));
    let Some((place, first)) = place.zip(rows.first().map(|row| row.leading.clone())) else {
        return RowPatch::Point;
    };
    if rows.iter().any(|row| row.leading[place] != first[place]) {
        return RowPatch::Other("circle".into());
    }
    leading.remove(place);
    rows.iter_mut().for_each(|row| {
        row.leading.remove(place);
    });
    RowPatch::Circle(first[place])
}

/// The names of the columns, and the number of the line behind them.
fn names<'t>(
    text: &'t str,
    columns: &ResultColumns,
) -> Result<(usize, Vec<&'t str>), MaterialError> {
    let wanted = || std::iter::once(&columns.wavelength).chain(&columns.values);
    let mut best: Vec<&str> = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let cells: Vec<&str> = line.split('\t').map(str::trim).collect();
        let found = |cells: &[&str]| wanted().filter(|name| cells.contains(&name.as_str())).count();
        if found(&cells) == 1 + columns.values.len() {
            return Ok((number + 1, cells));
        }
        if best.is_empty() || found(&cells) > found(&best) {
            best = cells;
        }
    }
    let missing = wanted().find(|name| !best.contains(&name.as_str())).cloned().unwrap_or_default();
    let help = did_you_mean(&missing, best.iter().copied()).unwrap_or_default();
    Err(MaterialError::request("columns", format!("no column is called {missing:?}; {help}")))
}

/// A line of the file.
struct ResultRow<'t> {
    number: usize,
    cells: Vec<&'t str>,
}

impl<'t> ResultRow<'t> {
    fn text(&self, column: usize) -> &'t str {
        self.cells.get(column).copied().unwrap_or_default()
    }

    fn number(&self, column: usize) -> Result<f64, MaterialError> {
        let text = self.text(column);
        whole_number(text).ok_or_else(|| {
            let part = format!("line {}", self.number);
            MaterialError::request(part, format!("column {}: {text:?} is not a number", column + 1))
        })
    }
}
