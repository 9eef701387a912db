//! Writes goniometer tables, direction by direction.

use std::io::{self, Write};

use mist_engine::{Control, material::MaterialError};
use rayon::prelude::*;
use scattering::{Basis, Geometry, Model};
use serde_json::json;
use sha2::{Digest, Sha256};

use super::layout::{GoniometerAxes, GoniometerForm, LIGHT_AZIMUTH};
use crate::export::{Bands, ExportError};

/// Directions per block of evaluation.
const BLOCK: usize = 4096;

/// Writes the table of `bands` on `axes` block by block.
///
/// # Errors
///
/// If the axes do not rise or reach the horizon, if the material is anisotropic or a value is not
/// finite, on cancellation, and if `out` fails.
pub fn write<W: Write>(
    bands: &Bands,
    axes: &GoniometerAxes,
    form: GoniometerForm,
    name: &str,
    mut out: W,
    control: &Control,
) -> Result<W, ExportError> {
    axes.check()?;
    if !bands.is_isotropic() {
        let problem = "the matrices change when the sample is rotated; the table has no rotation";
        return Err(ExportError::refused("material", problem));
    }
    match form {
        GoniometerForm::OpenMaterial => open_material(bands, axes, name, &mut out, control)?,
        GoniometerForm::Astm | GoniometerForm::Ocean => {
            columns(bands, axes, form, name, &mut out, control)?
        }
    }
    out.flush()?;
    Ok(out)
}

/// Calls `line` with every direction and its values, in order.
fn for_each_direction(
    bands: &Bands,
    axes: &GoniometerAxes,
    which: std::ops::Range<usize>,
    control: &Control,
    mut line: impl FnMut([f64; 3], &[f64]) -> io::Result<()>,
) -> Result<(), ExportError> {
    let rows: Vec<[f64; 3]> = axes.rows().collect();
    for block in rows.chunks(BLOCK) {
        if control.is_cancelled() {
            return Err(ExportError::Cancelled);
        }
        let values: Result<Vec<Vec<f64>>, ExportError> = block
            .par_iter()
            .map(|&[thetai, thetas, phis]| {
                let [theta_i, theta_s, phi_s] = [thetai, thetas, phis].map(f64::to_radians);
                let at = Geometry { theta_i, theta_s, phi_s, rotation: 0.0 };
                let value = |model: &Model| model.mueller(&at, Basis::Psps)[(0, 0)];
                let values: Vec<f64> = bands.models()[which.clone()].iter().map(value).collect();
                match values.iter().position(|f| !f.is_finite()) {
                    None => Ok(values),
                    Some(bad) => {
                        let nm = bands.nm()[which.start + bad];
                        let place =
                            format!("thetai {thetai}, thetas {thetas}, phis {phis}, {nm} nm");
                        Err(MaterialError::NotFinite(place).into())
                    }
                }
            })
            .collect();
        for (direction, values) in block.iter().zip(values?) {
            line(*direction, &values)?;
        }
    }
    Ok(())
}

/// One row per direction, one column per wavelength.
fn columns(
    bands: &Bands,
    axes: &GoniometerAxes,
    form: GoniometerForm,
    name: &str,
    out: &mut impl Write,
    control: &Control,
) -> Result<(), ExportError> {
    let waves: Vec<String> = bands.nm().iter().map(|nm| format!("{nm}nm")).collect();
    let waves = waves.join(",");
    let version = env!("CARGO_PKG_VERSION");
    let name = name.replace(['\n', '\r'], " ");
    match form {
        GoniometerForm::Astm => {
            writeln!(out, "PROGRAM mist {version}\nMATERIAL {name}")?;
            writeln!(out, "QUANTITY BRDF in 1/sr, without cosine, unpolarized light")?;
            writeln!(out, "NUM_POINTS {}", axes.directions())?;
            writeln!(out, "VARS theta_i,phi_i,theta_s,phi_s,{waves}")?;
        }
        _ => {
            let name = name.replace(',', " ");
            writeln!(out, "generator,mist {version}\nmaterial,{name}")?;
            writeln!(out, "quantity,BRDF in 1/sr without cosine for unpolarized light")?;
            writeln!(out, "theta-in,phi-in,theta-out,phi-out,{waves}")?;
        }
    }
    let angle =
        |degrees: f64| if form == GoniometerForm::Astm { degrees.to_radians() } else { degrees };
    let mut done = 0;
    for_each_direction(
        bands,
        axes,
        0..bands.nm().len(),
        control,
        |[thetai, thetas, phis], values| {
            let [i, light, s, phi] = [thetai, LIGHT_AZIMUTH, thetas, phis].map(angle);
            write!(out, "{i},{light},{s},{phi}")?;
            for value in values {
                write!(out, ",{value:e}")?;
            }
            done += 1;
            control.report(f64::from(done) / axes.directions() as f64);
            writeln!(out)
        },
    )
}

fn open_material(
    bands: &Bands,
    axes: &GoniometerAxes,
    name: &str,
    out: &mut impl Write,
    control: &Control,
) -> Result<(), ExportError> {
    let metres = |nm: f64| nm * 1e-9;
    let axes = &GoniometerAxes { phis: normalized_azimuths(&axes.phis), ..axes.clone() };
    let metadata = json!({
        "name": name,
        "uuid": uuid(&format!("{name} {:?} {axes:?}", bands.nm())),
        "materialVersion": "1.0.0",
        "openMaterial3dVersion": "1.0.0",
        "copyrights": ["of the owner of the material"],
        "license": "see the owner of the material",
        "authors": ["the author of the material"],
        "sources": format!("simulated with mist {}", env!("CARGO_PKG_VERSION")),
        "description": "BRDF in 1/sr without cosine, unpolarized light; rows: wavelength in m, \
            theta_i, theta_o, phi_o in radians; phi_o = 0 is the side of the specular reflection",
    });
    let wavelengths: Vec<f64> = bands.nm().iter().map(|nm| metres(*nm)).collect();
    write!(
        out,
        "{{\"metadata\":{metadata},\n\"brdf\":{{\"wavelengths\":{},\n\"lookupTable\":[",
        json!(wavelengths)
    )?;
    let mut comma = "\n";
    for (number, nm) in bands.nm().iter().enumerate() {
        for_each_direction(bands, axes, number..number + 1, control, |direction, values| {
            let [i, o, phi] = direction.map(f64::to_radians);
            // Rounding can make a value negative; the format refuses negative values.
            write!(out, "{comma}[{:e},{i},{o},{phi},{:e}]", metres(*nm), values[0].max(0.0))?;
            comma = ",\n";
            Ok(())
        })?;
        control.report((number + 1) as f64 / bands.nm().len() as f64);
    }
    writeln!(out, "\n]}}}}")?;
    Ok(())
}

/// The azimuths in 0 … 360°, rising, as the format requires.
fn normalized_azimuths(phis: &[f64]) -> Vec<f64> {
    let mut phis: Vec<f64> = phis.iter().map(|phi| phi.rem_euclid(360.0)).collect();
    phis.sort_by(f64::total_cmp);
    phis.dedup();
    phis
}

/// A UUID from the digest of `text`: version 8 of RFC 9562.
fn uuid(text: &str) -> String {
    let mut bytes = [0; 16];
    bytes.copy_from_slice(&Sha256::digest(text)[..16]);
    bytes[6] = bytes[6] & 0x0f | 0x80;
    bytes[8] = bytes[8] & 0x3f | 0x80;
    let hex: String = bytes.iter().map(|b| format!("{b:02x}")).collect();
    [&hex[..8], &hex[8..12], &hex[12..16], &hex[16..20], &hex[20..]].join("-")
}
