//! The files of the materials of a scene: programs, tables, and scenes that use them.
//!
//! Product A is one table in linear Rec.709 under D65 per material, with a second one behind its
//! polarizer; in the scene a `composite_material` takes the BRDF from the table and reflects indirect
//! light as a Lambertian body of the table's reflectance. Product B has three wavelengths instead of
//! red, green and blue, one scene per triple, for white lights.

mod files;
mod output;
mod rings;
mod scenes;

use std::sync::Arc;

use mist_engine::{Control, Files, Warning};

pub use output::BridgeFiles;
pub use rings::table_of;
pub use scenes::images;

use super::{
    material::{SceneMaterial, scene_materials},
    program::program,
    scene::chunks,
    table::{RingTable, into_gamut},
};
use crate::export::ExportError;

use files::RecordedFiles;
use output::MaterialTables;
use rings::RingRun;

/// The options of [`make`].
#[derive(Clone, Debug, PartialEq)]
pub struct BridgeOptions {
    /// Nodes of each polar angle: 46 are 2° apart.
    pub nodes: usize,
    /// Wavelengths, nm, rising.
    pub wavelengths: Vec<f64>,
    /// Also convert RISE's own materials.
    pub derive: bool,
    /// Also make product B.
    pub bands: bool,
}

/// Makes the files for the materials of the scene `text`, whose file is called `stem`.
///
/// # Errors
///
/// If the scene has no material for mist, or a material is invalid.
pub fn make(
    text: &str,
    stem: &str,
    files: &Arc<dyn Files + Send + Sync>,
    options: &BridgeOptions,
    control: &Control,
) -> Result<BridgeFiles, ExportError> {
    let chunks = chunks(text)?;
    let (materials, skipped) = scene_materials(&chunks, &**files, options.derive)?;
    if materials.is_empty() {
        let problem = format!(
            "no material has a comment # mist: …, and none was derived from RISE's own \
             parameters {skipped:?}"
        );
        return Err(ExportError::refused("scene", problem));
    }
    let mut output = BridgeFiles { skipped, ..BridgeFiles::default() };
    let mut tables = Vec::new();
    for (number, material) in materials.iter().enumerate() {
        let notes = material.invented.iter().map(|note| format!("{}: {note}", material.name));
        output.invented.extend(notes);
        tables.push(make_tables(material, stem, files, options, control, &mut output)?);
        control.report((number + 1) as f64 / materials.len() as f64);
    }
    scenes::add_scenes(text, stem, &chunks, &materials, &tables, &mut output);
    output.files.insert("rise.options".into(), b"force_number_of_threads 2\n".to_vec());
    Ok(output)
}

/// Makes the tables of one material, with its program and data files.
fn make_tables(
    material: &SceneMaterial,
    scene: &str,
    files: &Arc<dyn Files + Send + Sync>,
    options: &BridgeOptions,
    control: &Control,
    output: &mut BridgeFiles,
) -> Result<MaterialTables, ExportError> {
    let name = &material.name;
    let ring_program = program(material, scene, options.nodes, &options.wavelengths);
    let recorded = Arc::new(RecordedFiles::new(material, &ring_program, files.clone()));
    let run = RingRun::run(&ring_program, &recorded, control)?;
    output.warnings.extend(run.warnings.iter().map(|warning| of_material(name, warning)));
    let nodes = options.nodes;
    let rgb = run.table.rows.iter().map(|row| into_gamut(row.rgb[0])).collect();
    let mut tables =
        MaterialTables { plain: format!("{name}.RISEdataBSDF"), filtered: None, bands: Vec::new() };
    output.add(&tables.plain, RingTable::new(nodes, rgb)?);
    if let Some(filter) = material.filter {
        let file = format!("{name}_pol.RISEdataBSDF");
        let (nodes, nm) = (options.nodes, &options.wavelengths);
        output.add(&file, table_of(&run.prepared, Some(filter), nodes, nm, control)?);
        tables.filtered = Some(file);
    }
    if options.bands {
        for (band, triple) in triples(options.wavelengths.len()).enumerate() {
            let file = format!("{name}_b{band:02}.RISEdataBSDF");
            let rows = run.table.rows.iter();
            let values = rows.map(|row| triple.map(|k| row.spectra[0][k].max(0.0))).collect();
            output.add(&file, RingTable::new(nodes, values)?);
            tables.bands.push(file);
        }
    }
    output.text(&format!("{name}.mist"), ring_program.program);
    output.text(&ring_program.rings.0, ring_program.rings.1);
    output.text(&ring_program.waves.0, ring_program.waves.1);
    output.text(&ring_program.results, run.results);
    for (file, text) in recorded.read_files() {
        output.text(&file, text.to_string());
    }
    Ok(tables)
}

/// The warning with the name of the material.
fn of_material(name: &str, warning: &Warning) -> Warning {
    Warning { message: format!("material {name}: {}", warning.message), ..warning.clone() }
}

/// The indices of the wavelengths that replace red, green and blue, per render.
pub(super) fn triples(count: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..count).step_by(3).map(move |first| [0, 1, 2].map(|k| (first + k).min(count - 1)))
}
