//! Tables of a material: means over rings, by a ring program or by the engine directly.

use std::sync::Arc;

use mist_engine::{
    Control, Limits, MemorySink, Options, Warning,
    colour::{ColourRow, ColourTable},
    compile,
    material::{
        PreparedMaterial,
        results::{self, ResultColumns},
        table,
    },
    request::{ColourQuery, GridPatch, GridRequest, TableDirections, TableRequest},
};
use scattering::{Basis, Mode};

use super::files::RecordedFiles;
use crate::{
    export::ExportError,
    rise::{
        material::SurfacePolarizer,
        program::RingProgram,
        table::{RingTable, into_gamut},
    },
};

/// The results of a ring program, and their table.
pub(super) struct RingRun {
    pub(super) results: String,
    pub(super) table: ColourTable,
    pub(super) prepared: PreparedMaterial,
    pub(super) warnings: Vec<Warning>,
}

impl RingRun {
    /// Runs the program.
    pub(super) fn run(
        written: &RingProgram,
        files: &Arc<RecordedFiles>,
        control: &Control,
    ) -> Result<Self, ExportError> {
        let refused = |problem: String| ExportError::refused(&written.results, problem);
        let name = written.results.trim_end_matches(".dat");
        let options = Options { mode: Mode::Sound, job: name.to_owned(), ..Options::default() };
        let job = compile(&written.program, files.clone(), &options).map_err(|found| {
            let first = found.first();
            refused(first.map_or_else(String::new, |d| format!("its program: {}", d.message)))
        })?;
        let prepared =
            PreparedMaterial::of_step(&job).map_err(|failure| refused(failure.to_string()))?;
        let mut sink = MemorySink::default();
        let own = Control { cancel: control.cancel.clone(), progress: None };
        let summary = job.run(&mut sink, &own).map_err(|failure| refused(failure.to_string()))?;
        let limits = summary.met.iter().filter_map(Warning::of_notice);
        let slips = job.slips();
        let warnings = slips.iter().chain(&summary.warnings).map(Warning::from);
        let warnings = warnings.chain(limits).collect();
        let columns = ResultColumns::parse("wl:nm", "f")?;
        let settings = ColourQuery::default().settings(None)?;
        let incident = [1.0, 0.0, 0.0, 0.0];
        let table = results::table(&sink.results, &columns, name, &settings, (incident, "psps"))?;
        Ok(Self { results: sink.results, table, prepared, warnings })
    }
}

/// The table of a material, without a program: means over rings by Gauss's rule. Behind a polarizer
/// along s or p it is doubled, so that unpolarized light keeps its brightness.
///
/// # Errors
///
/// As the colour table of a material; if there are fewer than three nodes.
pub fn table_of(
    material: &PreparedMaterial,
    filter: Option<SurfacePolarizer>,
    nodes: usize,
    wavelengths: &[f64],
    control: &Control,
) -> Result<RingTable, ExportError> {
    if nodes < 3 {
        return Err(ExportError::refused("nodes", "a table has at least three nodes"));
    }
    let thetas: Vec<f64> = (0..nodes).map(|k| 90.0 * k as f64 / (nodes - 1) as f64).collect();
    // As in the program: the row of the horizon is that of 89°.
    let thetai = thetas.iter().map(|theta| theta.min(89.0)).collect();
    let grid = GridRequest { thetai, thetas, phis: vec![0.0], patch: GridPatch::Ring };
    let request = TableRequest {
        material: String::new(),
        directions: TableDirections::Grid(grid),
        wavelengths: wavelengths.to_vec(),
        settings: ColourQuery::default().settings(None)?,
        incident: [1.0, 0.0, 0.0, 0.0],
        stokes: true,
        basis: Basis::Psps,
        sampling: None,
        limits: Limits::default(),
    };
    let own = Control { cancel: control.cancel.clone(), progress: None };
    let table = table::table(material, &request, &own)?;
    let sign = match filter {
        None => 0.0,
        Some(SurfacePolarizer::S) => 1.0,
        Some(SurfacePolarizer::P) => -1.0,
    };
    let behind =
        |row: &ColourRow| into_gamut(std::array::from_fn(|c| row.rgb[0][c] + sign * row.rgb[1][c]));
    RingTable::new(nodes, table.rows.iter().map(behind).collect())
}
