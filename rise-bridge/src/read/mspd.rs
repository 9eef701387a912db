//! Reads `.mspd`.

use mist_engine::colour::ColourTable;

use super::{error::ReadError, mtab::describe, text::TextTable};
use crate::column;

/// The spectra of one Stokes component.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectraTable {
    /// The header; the table has no rows.
    pub table: ColourTable,
    /// The Stokes component: `I`, `Q`, `U` or `V`.
    pub component: char,
    /// The rows, in the order of the layout.
    pub rows: Vec<SpectraRow>,
}

/// One spectrum with its patch.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectraRow {
    /// Values of the leading columns.
    pub leading: Vec<f64>,
    /// Polar angle of incidence, degrees.
    pub thetai: f64,
    /// Polar angle of scattering, degrees.
    pub thetas: f64,
    /// Azimuth of scattering, degrees.
    pub phis: f64,
    /// Projected solid angle, sr.
    pub omega: f64,
    /// One value per wavelength.
    pub values: Vec<f64>,
}

/// Reads `.mspd` text.
///
/// # Errors
///
/// If the text is not a table, is cut off or was changed, or if its columns are not the wavelengths
/// that its header names.
pub fn mspd(text: &str) -> Result<SpectraTable, ReadError> {
    let text = TextTable::parse(text)?;
    let table = describe(&text)?;
    let stokes = text.line("stokes")?;
    let component = match stokes.value {
        "I" => 'I',
        "Q" => 'Q',
        "U" => 'U',
        "V" => 'V',
        _ => return Err(stokes.error("expected I, Q, U or V")),
    };
    let leading = table.leading.len();
    let patch = column::PATCH.len();
    let (found, expected) = (text.columns.len(), leading + patch + table.wavelengths.len());
    if found != expected {
        return Err(text
            .line("wavelengths")?
            .error(format!("{found} columns where the wavelengths make {expected}")));
    }
    let rows = text.rows.iter().map(|row| SpectraRow {
        leading: row[..leading].to_vec(),
        thetai: row[leading],
        thetas: row[leading + 1],
        phis: row[leading + 2],
        omega: row[leading + 3],
        values: row[leading + patch..].to_vec(),
    });
    Ok(SpectraTable { component, rows: rows.collect(), table })
}
