//! Reads goniometer tables; every error names its line.

use serde::Deserialize;

use super::layout::{GoniometerForm, LIGHT_AZIMUTH};
use crate::export::ExportError;

/// A table of measured or computed directions.
#[derive(Clone, Debug, PartialEq)]
pub struct GoniometerTable {
    /// Wavelengths, nm, in the order of the values.
    pub nm: Vec<f64>,
    /// The directions.
    pub rows: Vec<GoniometerRow>,
}

/// A pair of directions in degrees, with its values.
#[derive(Clone, Debug, PartialEq)]
pub struct GoniometerRow {
    /// Polar angle of incidence.
    pub thetai: f64,
    /// Polar angle of scattering.
    pub thetas: f64,
    /// Azimuth of scattering; 0 on the specular side, from −180 to 180.
    pub phis: f64,
    /// BRDF (1/sr) per wavelength.
    pub values: Vec<f64>,
}

#[derive(Deserialize)]
struct OpenMaterialDocument {
    brdf: OpenMaterialBrdf,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct OpenMaterialBrdf {
    wavelengths: Vec<f64>,
    lookup_table: Vec<[f64; 5]>,
}

/// Reads the table in `text`.
///
/// # Errors
///
/// If the text violates the form; the error names the line and what is expected.
pub fn read(text: &str, form: GoniometerForm) -> Result<GoniometerTable, ExportError> {
    match form {
        GoniometerForm::OpenMaterial => open_material(text),
        GoniometerForm::Astm => columns(text, "theta_i,phi_i,theta_s,phi_s,", f64::to_degrees),
        GoniometerForm::Ocean => columns(text, "theta-in,phi-in,theta-out,phi-out,", |x| x),
    }
}

fn columns(
    text: &str,
    head: &str,
    degrees: fn(f64) -> f64,
) -> Result<GoniometerTable, ExportError> {
    let mut stated = None;
    let mut lines = text.lines().enumerate();
    let nm = loop {
        let Some((_, line)) = lines.next() else {
            let problem = format!("no line begins with the columns {head}…");
            return Err(ExportError::refused("header", problem));
        };
        if let Some(count) = line.strip_prefix("NUM_POINTS ") {
            stated = count.trim().parse::<usize>().ok();
        }
        let names = line.strip_prefix("VARS ").unwrap_or(line);
        if let Some(waves) = names.strip_prefix(head) {
            break waves.split(',').map(wavelength).collect::<Result<Vec<f64>, _>>()?;
        }
    };
    let mut rows = Vec::new();
    for (number, line) in lines.filter(|(_, line)| !line.trim().is_empty()) {
        let wrong = || {
            let problem = format!("expected {} finite numbers separated by commas", 4 + nm.len());
            ExportError::refused(&format!("line {}", number + 1), problem)
        };
        let numbers: Result<Vec<f64>, _> = line.split(',').map(|w| w.trim().parse()).collect();
        let numbers = numbers.map_err(|_| wrong())?;
        let good = numbers.len() == 4 + nm.len() && numbers.iter().all(|x| x.is_finite());
        let (angles, values) = numbers.split_at_checked(4).filter(|_| good).ok_or_else(wrong)?;
        rows.push(GoniometerRow {
            thetai: degrees(angles[0]),
            thetas: degrees(angles[2]),
            phis: from_specular(degrees(angles[3]) - degrees(angles[1])),
            values: values.to_vec(),
        });
    }
    if stated.is_some_and(|count| count != rows.len()) {
        let problem = format!("{} rows, but NUM_POINTS says {}", rows.len(), stated.unwrap_or(0));
        return Err(ExportError::refused("rows", problem));
    }
    Ok(GoniometerTable { nm, rows })
}

/// The azimuth relative to the specular side, from the azimuth of the viewer minus that of the light.
fn from_specular(difference: f64) -> f64 {
    let around = (difference + 180.0).rem_euclid(360.0);
    if around > 180.0 + 1e-9 { around - 360.0 } else { around }
}

fn wavelength(name: &str) -> Result<f64, ExportError> {
    let number = name.trim().strip_suffix("nm").and_then(|text| text.parse().ok());
    number.ok_or_else(|| {
        ExportError::refused("columns", format!("{name:?} is not a wavelength such as 450nm"))
    })
}

fn open_material(text: &str) -> Result<GoniometerTable, ExportError> {
    let document: OpenMaterialDocument = serde_json::from_str(text)
        .map_err(|error| ExportError::refused("document", error.to_string()))?;
    let OpenMaterialBrdf { wavelengths, lookup_table } = document.brdf;
    let count = wavelengths.len();
    if count == 0 || !lookup_table.len().is_multiple_of(count) {
        let problem = format!("{} rows for {count} wavelengths", lookup_table.len());
        return Err(ExportError::refused("lookupTable", problem));
    }
    let per_wave = lookup_table.len() / count;
    let mut rows = Vec::with_capacity(per_wave);
    for k in 0..per_wave {
        let [_, i, o, phi, _] = lookup_table[k];
        let mut values = Vec::with_capacity(count);
        for w in 0..count {
            let row = lookup_table[w * per_wave + k];
            if row[0] != wavelengths[w] || row[1..4] != [i, o, phi] || !(row[4] >= 0.0) {
                let part = format!("lookupTable, row {}", w * per_wave + k + 1);
                let problem = "expected the directions of the first wavelength in its order, and \
                               no negative value";
                return Err(ExportError::refused(&part, problem));
            }
            values.push(row[4]);
        }
        let [thetai, thetas, phis] = [i, o, phi].map(f64::to_degrees);
        rows.push(GoniometerRow {
            thetai,
            thetas,
            phis: from_specular(phis - LIGHT_AZIMUTH),
            values,
        });
    }
    Ok(GoniometerTable { nm: wavelengths.iter().map(|m| m * 1e9).collect(), rows })
}
