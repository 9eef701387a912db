//! Mueller matrices and spectra of solid angles, row by row: as text and as JSON.

use mist_engine::{
    Warning, colour::ColourTable, material::table::MuellerRow, request::TableRequest,
};
use serde_json::{Value, json};

use super::{
    error::WriteError,
    header::{columns, node},
    rows::{TextRows, finite},
    style::Style,
};
use crate::column;

/// First line of the text, without `# `.
const MAGIC: &str = "MIST-MUELLER 1";

/// The mean Mueller matrices (1/sr) of the rows of `request`: per row the patch, then sixteen
/// numbers per wavelength, row by row, then the flags.
///
/// # Errors
///
/// If a number is not finite.
pub fn mueller(
    request: &TableRequest,
    rows: &[MuellerRow],
    style: Style,
) -> Result<String, WriteError> {
    let names = names(request);
    let mut text = TextRows::new(&names, style.digits);
    for row in rows {
        text.push(&values(row), Some(row.flags))?;
    }
    let waves: Vec<String> = request.wavelengths.iter().copied().map(node).collect();
    let material = request.material.replace(char::is_control, " ");
    let head = format!(
        "# {MAGIC}\n# material {material}\n# quantity brdf 1/sr\n# frame {}\n# wavelengths list {} nm\n",
        request.basis.name(),
        waves.join(" ")
    );
    let mut shown = names.clone();
    shown.push(column::FLAGS.into());
    Ok(head + &columns(&shown) + &text.finish())
}

/// The matrices as JSON: `{"wavelengths": […], "rows": [{"thetai": …, "mueller": [[16 numbers], …]}]}`.
///
/// # Errors
///
/// If a number is not finite.
pub fn mueller_json(request: &TableRequest, rows: &[MuellerRow]) -> Result<String, WriteError> {
    let names = names(request);
    for (at, row) in rows.iter().enumerate() {
        finite(at, &names, &values(row))?;
    }
    let one = |row: &MuellerRow| {
        let [thetai, thetas, phis] = row.angles;
        let matrices: Vec<[f64; 16]> = row.matrices.iter().map(|m| m.to_row_major()).collect();
        json!({
            "thetai": thetai, "thetas": thetas, "phis": phis, "omega": row.omega,
            "mueller": matrices, "flags": row.flags,
        })
    };
    let rows: Vec<_> = rows.iter().map(one).collect();
    let document = json!({
        "format": MAGIC,
        "material": request.material,
        "quantity": "brdf 1/sr",
        "frame": request.basis.name(),
        "wavelengths": request.wavelengths,
        "rows": rows,
    });
    let document = with_warnings(document, &request.warnings());
    Ok(document.to_string() + "\n")
}

/// The spectra of the Stokes component `component` of every row:
/// `{"wavelengths": […], "rows": [{"thetai": …, "spectrum": […]}]}`.
///
/// # Errors
///
/// If a row has no such spectrum or a number is not finite.
pub fn spectra_json(table: &ColourTable, component: usize) -> Result<String, WriteError> {
    let names: Vec<String> = table.wavelengths.iter().copied().map(node).collect();
    let mut rows = Vec::new();
    for (at, row) in table.rows.iter().enumerate() {
        let spectrum = &row.spectra[component];
        if spectrum.len() != table.wavelengths.len() {
            let component = ['I', 'Q', 'U', 'V'][component];
            return Err(WriteError::NoSpectrum { row: at + 1, component });
        }
        finite(at, &names, spectrum)?;
        rows.push(json!({
            "thetai": row.thetai, "thetas": row.thetas, "phis": row.phis, "omega": row.omega,
            "spectrum": spectrum, "flags": row.flags,
        }));
    }
    let stokes = ["I", "Q", "U", "V"][component];
    let document = json!({
        "material": table.material,
        "quantity": table.quantity,
        "stokes": stokes,
        "wavelengths": table.wavelengths,
        "rows": rows,
    });
    let document = with_warnings(document, &table.warnings);
    Ok(document.to_string() + "\n")
}

/// The document with the key `warnings`, if there are any.
fn with_warnings(mut document: Value, warnings: &[Warning]) -> Value {
    if !warnings.is_empty() {
        document["warnings"] = json!(warnings);
    }
    document
}

fn names(request: &TableRequest) -> Vec<String> {
    let element = |nm: &f64| {
        let nm = node(*nm);
        (0..16).map(move |k| format!("m{}{}@{nm}", k / 4, k % 4)).collect::<Vec<_>>()
    };
    let place = column::PATCH.map(str::to_owned).into_iter();
    place.chain(request.wavelengths.iter().flat_map(element)).collect()
}

fn values(row: &MuellerRow) -> Vec<f64> {
    let mut values = row.angles.to_vec();
    values.push(row.omega);
    values.extend(row.matrices.iter().flat_map(|m| m.to_row_major()));
    values
}
