//! Writer of `.bsdf` of the RGL.

use std::io::Write;

use mist_engine::{Control, material::PreparedMaterial};

use super::export::{ExportRequest, error_of_f};
use crate::{
    export::{Bands, ExportError},
    mitsuba::bsdf::{self, BsdfChannels, BsdfSize},
};

/// Viewers and pixels of a table for which no grid was asked: isotropic, and not.
const GRIDS: [&str; 2] = ["24x64", "37x20x48"];

/// Writes the table; the line has the error of interpolation.
pub(super) fn write(
    material: &PreparedMaterial,
    request: &ExportRequest,
    out: &mut dyn Write,
    control: &Control,
) -> Result<String, ExportError> {
    let (usual, channels) = match request.rgb {
        false => ("400:10:700", BsdfChannels::Spectra),
        true => ("360:10:830", BsdfChannels::Rgb),
    };
    let bands = Bands::new(material, &request.wavelengths(usual)?)?;
    let grid = GRIDS[usize::from(!bands.is_isotropic())];
    let grid = request.grid.as_deref().unwrap_or(grid);
    let (size, error) = match request.tolerance(grid)? {
        Some(part) => {
            let (size, error) = bsdf::choose_size(&bands, channels, part)?;
            (size, Some(error))
        }
        None => {
            let size = BsdfSize::parse(grid)?;
            let BsdfSize { phi_i, theta_i, side } = size;
            request.refuse_above(&[phi_i, theta_i, side, side, 4, bands.nm().len() + 1])?;
            let estimate = || bsdf::interpolation_error(&bands, channels, size);
            (size, request.estimate_error.then(estimate).transpose()?)
        }
    };
    let description = request.description("BRDF times the cosine of the light, 1/sr");
    bsdf::write(&bands, channels, size, &description, out, control)?;
    let content = match channels {
        BsdfChannels::Rgb => "linear sRGB".to_owned(),
        BsdfChannels::Spectra => format!("{} wavelengths", bands.nm().len()),
    };
    let BsdfSize { phi_i, theta_i, side } = size;
    let mut line = format!("{phi_i}x{theta_i} viewers, {side}x{side} pixels, {content}");
    if let Some(error) = error {
        line += &format!("; between the nodes {}", error_of_f(error.median, error.quantile_95));
    }
    Ok(line)
}
