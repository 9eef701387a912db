//! Tables of goniometers.

use mist_engine::material::{query, table::GridPatch};
use rise_bridge::{
    export::Bands,
    goniometer::{self, Axes, Form},
};

use super::{Stop, Work, not_exported, refused};

/// Nodes of a table for which no grid was asked.
const GRID: &str = "thetai=0:10:80,thetas=0:5:85,phis=0:10:180";

/// Writes the table and tells about it.
pub(super) fn write(work: &Work<'_>, form: Form) -> Result<String, Stop> {
    let grid = query::grid(work.args.grid.as_deref().unwrap_or(GRID), GridPatch::Point);
    let grid = grid.map_err(refused)?;
    let axes = Axes { thetai: grid.thetai, thetas: grid.thetas, phis: grid.phis };
    let bands = Bands::new(&work.material, &work.wavelengths).map_err(not_exported)?;
    let name = work.source.stem();
    work.save(|file| goniometer::write(&bands, &axes, form, &name, file, &work.control))?;
    let (path, waves) = (work.path.display(), bands.nm().len());
    Ok(format!("{path}: {} directions, {waves} wavelengths\n", axes.directions()))
}
