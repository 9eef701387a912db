//! Colours and spectra as CSV, for spreadsheets and data frames: one line of titles with units, then
//! numbers.

use std::fmt::Write as _;

use mist_engine::colour::{ColourRow, ColourTable};

use super::{
    error::WriteError,
    rows::{finite, number},
    style::Style,
};
use crate::column;

/// The colour table as CSV.
///
/// # Errors
///
/// If a number is not finite.
pub fn csv(table: &ColourTable, style: Style) -> Result<String, WriteError> {
    let names = column::names(table, style.xyz);
    let (unit, first) = (unit(table), column::patch_names(table).len());
    let titles = names.iter().enumerate().map(|(at, name)| match name.as_str() {
        column::FLAGS => name.clone(),
        name if at < first => with_unit(name, patch_unit(name)),
        name => with_unit(name, unit),
    });
    let flags = |row: &ColourRow| Some(row.flags.to_string());
    let values = |row: &ColourRow| Ok(column::values(table, row, style.xyz));
    rows(table, titles.collect(), values, flags, style.digits)
}

/// The spectra of the Stokes component `component` as CSV, a column per wavelength.
///
/// # Errors
///
/// If a number is not finite, or the component was not given.
pub fn csv_spectra(
    table: &ColourTable,
    component: usize,
    style: Style,
) -> Result<String, WriteError> {
    let patch = column::patch_names(table);
    let mut titles: Vec<String> =
        patch.iter().map(|name| with_unit(name, patch_unit(name))).collect();
    let wave = |nm: &f64| with_unit(&format!("{} nm", number(*nm, 9)), unit(table));
    titles.extend(table.wavelengths.iter().map(wave));
    let values = |row: &ColourRow| {
        let spectrum = &row.spectra[component];
        let is_given = spectrum.len() == table.wavelengths.len();
        is_given.then(|| [column::patch_values(row), spectrum.clone()].concat()).ok_or_else(|| {
            let at = table.rows.iter().position(|other| std::ptr::eq(other, row)).unwrap_or(0);
            let component = ['I', 'Q', 'U', 'V'][component];
            WriteError::NoSpectrum { row: at + 1, component }
        })
    };
    rows(table, titles, values, |_| None, style.digits)
}

/// The line of titles and a line per row.
fn rows(
    table: &ColourTable,
    titles: Vec<String>,
    values: impl Fn(&ColourRow) -> Result<Vec<f64>, WriteError>,
    last: impl Fn(&ColourRow) -> Option<String>,
    digits: usize,
) -> Result<String, WriteError> {
    let mut text = titles.iter().map(|title| quoted(title)).collect::<Vec<_>>().join(",") + "\n";
    for (at, row) in table.rows.iter().enumerate() {
        let values = values(row)?;
        finite(at, &titles, &values)?;
        let cells = values.iter().map(|value| number(*value, digits)).chain(last(row));
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", cells.collect::<Vec<_>>().join(","));
    }
    Ok(text)
}

/// The unit of the table's quantity; empty for pure numbers.
fn unit(table: &ColourTable) -> &str {
    match table.quantity.split_once(' ') {
        Some((_, unit)) if unit != "1" => unit,
        _ => "",
    }
}

fn patch_unit(name: &str) -> &'static str {
    match name {
        "thetai" | "thetas" | "phis" => "deg",
        "omega" => "sr",
        _ => "",
    }
}

fn with_unit(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.to_owned() } else { format!("{name} ({unit})") }
}

fn quoted(title: &str) -> String {
    if title.contains([',', '"', '\n']) {
        format!("\"{}\"", title.replace('"', "\"\""))
    } else {
        title.to_owned()
    }
}
