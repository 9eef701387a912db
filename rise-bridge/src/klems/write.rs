//! Writes Klems XML.

use std::io::Write;

use glam::DVec3;
use mist_engine::Control;
use rayon::prelude::*;

use super::{
    basis::{BASIS, RINGS, patches},
    mean::{MeansUnderLight, equal_energy},
};
use crate::export::{Bands, ExportError};

/// Writes the file for `bands`.
///
/// # Errors
///
/// If the material is anisotropic or a value is not finite, if the wavelengths give no colour, on
/// cancellation, and if `out` fails.
pub fn write<W: Write>(
    bands: &Bands,
    name: &str,
    mut out: W,
    control: &Control,
) -> Result<W, ExportError> {
    if !bands.is_isotropic() {
        let problem = "the matrices change when the sample is rotated; a Klems file holds isotropic \
                       materials only";
        return Err(ExportError::refused("material", problem));
    }
    let plan = equal_energy(bands)?;
    let patches = patches();
    let mut columns = Vec::with_capacity(patches.len());
    for (k, from) in patches.iter().enumerate() {
        if control.is_cancelled() {
            return Err(ExportError::Cancelled);
        }
        // The index of an incident patch is that of the direction in which its light travels.
        let middle = from.centre();
        let light = DVec3::new(-middle.x, -middle.y, middle.z);
        let means = MeansUnderLight::new(bands, &plan, light);
        let column: Result<Vec<[f64; 3]>, ExportError> =
            patches.par_iter().map(|to| means.xyz(to)).collect();
        columns.push(column?);
        control.report((k + 1) as f64 / patches.len() as f64);
    }
    header(&mut out, name)?;
    for (band, component) in [("Visible", 1), ("CIE-X", 0), ("CIE-Z", 2)] {
        for side in ["Reflection Back", "Reflection Front"] {
            data_block(&mut out, band, side, |to, from| columns[from][to][component])?;
        }
    }
    out.write_all(b"</Layer>\n</Optical>\n</WindowElement>\n")?;
    out.flush()?;
    Ok(out)
}

/// The elements before the data.
fn header(out: &mut impl Write, name: &str) -> std::io::Result<()> {
    let name = name.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    writeln!(
        out,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <WindowElement xmlns=\"http://windows.lbl.gov\">\n\
         <WindowElementType>System</WindowElementType>\n<FileType>BSDF</FileType>\n\
         <Optical>\n<Layer>\n<Material>\n<Name>{name}</Name>\n\
         <Manufacturer>computed with mist {}</Manufacturer>\n<DeviceType>Other</DeviceType>\n\
         </Material>\n<DataDefinition>\n\
         <IncidentDataStructure>Columns</IncidentDataStructure>\n\
         <AngleBasis>\n<AngleBasisName>{BASIS}</AngleBasisName>",
        env!("CARGO_PKG_VERSION")
    )?;
    let mut lower = 0.0;
    for (upper, count) in RINGS {
        let theta = if lower == 0.0 { 0.0 } else { 0.5 * (lower + upper) };
        writeln!(
            out,
            "<AngleBasisBlock><Theta>{theta}</Theta><nPhis>{count}</nPhis><ThetaBounds>\
             <LowerTheta>{lower}</LowerTheta><UpperTheta>{upper}</UpperTheta></ThetaBounds>\
             </AngleBasisBlock>"
        )?;
        lower = upper;
    }
    writeln!(out, "</AngleBasis>\n</DataDefinition>")
}

/// The values of one band on one side: a row per outgoing patch.
fn data_block(
    out: &mut impl Write,
    band: &str,
    side: &str,
    value: impl Fn(usize, usize) -> f64,
) -> std::io::Result<()> {
    writeln!(
        out,
        "<WavelengthData>\n<LayerNumber>System</LayerNumber>\n\
         <Wavelength unit=\"Integral\">{band}</Wavelength>\n\
         <SourceSpectrum>equal energy</SourceSpectrum>\n\
         <DetectorSpectrum>CIE 1931</DetectorSpectrum>\n<WavelengthDataBlock>\n\
         <WavelengthDataDirection>{side}</WavelengthDataDirection>\n\
         <ColumnAngleBasis>{BASIS}</ColumnAngleBasis>\n<RowAngleBasis>{BASIS}</RowAngleBasis>\n\
         <ScatteringDataType>BRDF</ScatteringDataType>\n<ScatteringData>"
    )?;
    let count: usize = RINGS.iter().map(|ring| ring.1).sum();
    for to in 0..count {
        let row: Vec<String> = (0..count).map(|from| format!("{:.6e}", value(to, from))).collect();
        writeln!(out, "{},", row.join(","))?;
    }
    writeln!(out, "</ScatteringData>\n</WavelengthDataBlock>\n</WavelengthData>")
}
