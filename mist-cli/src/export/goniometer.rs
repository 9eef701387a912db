//! Tables of goniometers.

use mist_engine::material::{query, table::GridPatch};
use rise_bridge::{
    export::Bands,
    goniometer::{self, GoniometerAxes, GoniometerForm},
};

use super::{Stop, Work, not_exported, refused, tolerance};

/// Nodes of a table for which no grid was asked.
const GRID: &str = "thetai=0:10:80,thetas=0:5:85,phis=0:10:180";

/// Writes the table and tells about it.
pub(super) fn write(work: &Work<'_>, form: GoniometerForm) -> Result<String, Stop> {
    let bands = Bands::new(&work.material, &work.wavelengths).map_err(not_exported)?;
    let grid = work.args.grid.as_deref().unwrap_or(GRID);
    let (axes, spread) = match tolerance(grid)? {
        Some(part) => goniometer::choose_axes(&bands, part).map_err(not_exported)?,
        None => {
            let grid = query::grid(grid, GridPatch::Point).map_err(refused)?;
            let axes = GoniometerAxes { thetai: grid.thetai, thetas: grid.thetas, phis: grid.phis };
            axes.check().map_err(not_exported)?;
            let spread = goniometer::interpolation_error(&bands, &axes);
            (axes, spread)
        }
    };
    let name = work.source.stem();
    work.save(|file| goniometer::write(&bands, &axes, form, &name, file, work.control))?;
    let (path, waves) = (work.path.display(), bands.nm().len());
    Ok(format!(
        "{path}: {} directions, {waves} wavelengths; between the nodes the error of f is {:.2} % \
         (median) and {:.2} % (95 % of the light)\n",
        axes.directions(),
        100.0 * spread.median,
        100.0 * spread.quantile_95,
    ))
}
