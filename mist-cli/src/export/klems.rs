//! Klems XML for Radiance and WINDOW.

use rise_bridge::{export::Bands, klems};

use super::{Stop, Work, not_exported};

/// Writes the file and tells about it.
pub(super) fn write(work: &Work<'_>) -> Result<String, Stop> {
    if work.args.grid.is_some() {
        return Err(Stop::Refused("--grid: a Klems file always has 145 x 145 patches".into()));
    }
    let bands = Bands::new(&work.material, &work.wavelengths).map_err(not_exported)?;
    let name = work.source.stem();
    work.save(|file| klems::write(&bands, &name, file, work.control))?;
    let spread = klems::interpolation_error(&bands).map_err(not_exported)?;
    Ok(format!(
        "{}: 145 x 145 patches, CIE X, Y and Z; inside the patches the error of f is {:.2} % (median) \
         and {:.2} % (95 % of the light)\n",
        work.path.display(),
        100.0 * spread.median,
        100.0 * spread.quantile_95,
    ))
}
