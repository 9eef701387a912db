//! `.bsdf` of the RGL.

use rise_bridge::{
    export::Bands,
    mitsuba::bsdf::{self, BsdfChannels, BsdfSize},
};

use super::{Stop, Work, not_exported, tolerance};

/// Viewers and pixels of a table for which no grid was asked: isotropic, and not.
const GRIDS: [&str; 2] = ["24x64", "37x20x48"];

/// Writes the table and tells about it.
pub(super) fn write(work: &Work<'_>) -> Result<String, Stop> {
    let bands = Bands::new(&work.material, &work.wavelengths).map_err(not_exported)?;
    let channels = if work.args.rgb { BsdfChannels::Rgb } else { BsdfChannels::Spectra };
    let usual = GRIDS[usize::from(!bands.is_isotropic())];
    let grid = work.args.grid.as_deref().unwrap_or(usual);
    let (size, spread) = match tolerance(grid)? {
        Some(part) => bsdf::choose_size(&bands, channels, part).map_err(not_exported)?,
        None => {
            let size = BsdfSize::parse(grid).map_err(not_exported)?;
            (size, bsdf::interpolation_error(&bands, channels, size).map_err(not_exported)?)
        }
    };
    let description = work.description("BRDF times the cosine of the light, 1/sr");
    work.save(|file| bsdf::write(&bands, channels, size, &description, file, work.control))?;
    let what = match channels {
        BsdfChannels::Rgb => "linear sRGB".to_owned(),
        BsdfChannels::Spectra => format!("{} wavelengths", bands.nm().len()),
    };
    let BsdfSize { phi_i, theta_i, side } = size;
    let path = work.path.display();
    Ok(format!(
        "{path}: {phi_i}x{theta_i} viewers, {side}x{side} pixels, {what}; between the nodes the error \
         of f is {:.2} % (median) and {:.2} % (95 % of the light)\n",
        100.0 * spread.median,
        100.0 * spread.quantile_95,
    ))
}
