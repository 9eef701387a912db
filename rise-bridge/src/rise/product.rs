//! From a scene to the files of its materials: programs, tables, and scenes that show them.
//!
//! Product A is one table in linear Rec.709 under D65 per material, with a second one behind its
//! filter; in the scene a `composite_material` takes the BRDF from the table and bounces light as a
//! Lambertian body of the table's reflectance. Product B has three wavelengths in the place of red,
//! green and blue, one scene per triple, for white lights.

use std::{
    collections::BTreeMap,
    fmt::Write,
    sync::{Arc, Mutex},
};

use mist_engine::{
    Control, FileError, Files, Limits, MemoryFiles, MemorySink, Options,
    colour::{ColourRow, ColourTable},
    compile,
    material::{
        Prepared,
        query::ColourNames,
        results::{self, Columns},
        table::{self, GridPatch, GridRequest, TableRequest, What, default_sampling},
    },
};
use scattering::{Basis, Mode};

use super::{
    material::{Described, Filter, described},
    program::{Written, program},
    scene::{Chunk, chunks, replaced},
    table::{RingTable, into_gamut},
};
use crate::export::ExportError;

/// What is made.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Nodes of each polar angle: 46 are 2° apart.
    pub nodes: usize,
    /// Wavelengths, nm, rising.
    pub wavelengths: Vec<f64>,
    /// Whether RISE's own materials are derived too.
    pub derive: bool,
    /// Whether product B is made.
    pub bands: bool,
}

/// What was made.
#[derive(Clone, Debug, Default)]
pub struct Made {
    /// Names and contents of the files.
    pub files: BTreeMap<String, Vec<u8>>,
    /// Scenes that can be rendered, by the names of their files.
    pub scenes: Vec<String>,
    /// The pictures of product B, render by render; [`super::stack::stack`] makes one of them.
    pub bands: Vec<String>,
    /// The tables by the names of their files.
    pub tables: BTreeMap<String, RingTable>,
    /// What was left as it is, with the reason.
    pub left: Vec<String>,
}

/// Makes the files for the materials of the scene `text`, whose file is called `stem`.
///
/// # Errors
///
/// For scenes without materials for us, and everything that is wrong with one of them.
pub fn make(
    text: &str,
    stem: &str,
    files: &Arc<dyn Files + Send + Sync>,
    wanted: &Wanted,
    control: &Control,
) -> Result<Made, ExportError> {
    let chunks = chunks(text)?;
    let (materials, left) = described(&chunks, &**files, wanted.derive)?;
    if materials.is_empty() {
        let problem = format!(
            "no material has a comment # mist: … for us, and none was derived from RISE's own \
             parameters {left:?}"
        );
        return Err(ExportError::refused("scene", problem));
    }
    let mut made = Made { left, ..Made::default() };
    let mut shown = Vec::new();
    for (number, material) in materials.iter().enumerate() {
        let done = one(material, stem, files, wanted, control, &mut made)?;
        shown.push(done);
        control.report((number + 1) as f64 / materials.len() as f64);
    }
    scenes(text, stem, &chunks, &materials, &shown, &mut made);
    made.files.insert("rise.options".into(), b"force_number_of_threads 2\n".to_vec());
    Ok(made)
}

/// The tables of one material by their names.
struct Shown {
    plain: String,
    filtered: Option<String>,
    bands: Vec<String>,
}

fn one(
    material: &Described,
    scene: &str,
    files: &Arc<dyn Files + Send + Sync>,
    wanted: &Wanted,
    control: &Control,
    made: &mut Made,
) -> Result<Shown, ExportError> {
    let name = &material.name;
    let written = program(material, scene, wanted.nodes, &wanted.wavelengths);
    let seen = Arc::new(Seen::new(material, &written, files.clone()));
    let run = Ran::run(&written, &seen, control)?;
    let nodes = wanted.nodes;
    let rgb = run.table.rows.iter().map(|row| into_gamut(row.rgb[0])).collect();
    let mut shown =
        Shown { plain: format!("{name}.RISEdataBSDF"), filtered: None, bands: Vec::new() };
    made.add(&shown.plain, RingTable::new(nodes, rgb)?);
    if let Some(filter) = material.filter {
        let file = format!("{name}_pol.RISEdataBSDF");
        let (nodes, nm) = (wanted.nodes, &wanted.wavelengths);
        made.add(&file, table_of(&run.prepared, Some(filter), nodes, nm, control)?);
        shown.filtered = Some(file);
    }
    if wanted.bands {
        for (band, triple) in triples(wanted.wavelengths.len()).enumerate() {
            let file = format!("{name}_b{band:02}.RISEdataBSDF");
            let rows = run.table.rows.iter();
            let values = rows.map(|row| triple.map(|k| row.spectra[0][k].max(0.0))).collect();
            made.add(&file, RingTable::new(nodes, values)?);
            shown.bands.push(file);
        }
    }
    made.text(&format!("{name}.mist"), written.program);
    made.text(&written.rings.0, written.rings.1);
    made.text(&written.waves.0, written.waves.1);
    made.text(&written.results, run.results);
    for (file, text) in seen.seen.lock().expect("nobody panics with the lock").iter() {
        made.text(file, text.to_string());
    }
    Ok(shown)
}

/// Which wavelengths stand in the place of red, green and blue, render by render.
pub(super) fn triples(count: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..count).step_by(3).map(move |first| [0, 1, 2].map(|k| (first + k).min(count - 1)))
}

impl Made {
    fn add(&mut self, file: &str, table: RingTable) {
        self.files.insert(file.to_owned(), table.bytes());
        self.tables.insert(file.to_owned(), table);
    }

    fn text(&mut self, file: &str, text: String) {
        self.files.insert(file.to_owned(), text.into_bytes());
    }
}

/// The files of a program: its lists, what was made for it, and those around the scene, which are
/// remembered.
struct Seen {
    own: MemoryFiles,
    around: Arc<dyn Files + Send + Sync>,
    seen: Mutex<BTreeMap<String, Arc<str>>>,
}

impl Seen {
    fn new(material: &Described, written: &Written, around: Arc<dyn Files + Send + Sync>) -> Self {
        let made = material.material.files.iter().chain([(&written.rings.0, &written.rings.1)]);
        let own = made.chain([(&written.waves.0, &written.waves.1)]);
        let own = own.map(|(name, text)| (name.clone(), text.as_str().into())).collect();
        let made = &material.material.files;
        let seen = made.iter().map(|(name, text)| (name.clone(), text.as_str().into())).collect();
        Self { own: MemoryFiles(own), around, seen: Mutex::new(seen) }
    }
}

impl Files for Seen {
    fn read(&self, name: &str) -> Result<Arc<str>, FileError> {
        if let Ok(text) = self.own.read(name) {
            return Ok(text);
        }
        let text = self.around.read(name)?;
        let mut seen = self.seen.lock().expect("nobody panics with the lock");
        // Names with folders stay where they are.
        if !name.contains(['/', '\\']) {
            seen.insert(name.to_owned(), text.clone());
        }
        Ok(text)
    }

    fn names(&self) -> Vec<String> {
        [self.own.names(), self.around.names()].concat()
    }
}

/// A program that was run, and its table read back.
struct Ran {
    results: String,
    table: ColourTable,
    prepared: Prepared,
}

impl Ran {
    fn run(written: &Written, files: &Arc<Seen>, control: &Control) -> Result<Self, ExportError> {
        let refused = |problem: String| ExportError::refused(&written.results, problem);
        let name = written.results.trim_end_matches(".dat");
        let options = Options { mode: Mode::Sound, job: name.to_owned(), ..Options::default() };
        let job = compile(&written.program, files.clone(), &options).map_err(|found| {
            let first = found.first();
            refused(first.map_or_else(String::new, |d| format!("its program: {}", d.message)))
        })?;
        let prepared = Prepared::of_step(&job).map_err(|failure| refused(failure.to_string()))?;
        let mut sink = MemorySink::default();
        let own = Control { cancel: control.cancel.clone(), progress: None };
        job.run(&mut sink, &own).map_err(|failure| refused(failure.to_string()))?;
        let columns = Columns::parse("wl:nm", "f")?;
        let settings = ColourNames::default().settings(None)?;
        let incident = [1.0, 0.0, 0.0, 0.0];
        let table = results::table(&sink.results, &columns, name, &settings, (incident, "psps"))?;
        Ok(Self { results: sink.results, table, prepared })
    }
}

/// The table of a material, without a program: means over rings by Gauss's rule. Behind a filter
/// that follows s and p it is twice as bright, so that unpolarized light keeps its brightness.
///
/// # Errors
///
/// As the colour table of a material; for fewer than three nodes.
pub fn table_of(
    material: &Prepared,
    filter: Option<Filter>,
    nodes: usize,
    wavelengths: &[f64],
    control: &Control,
) -> Result<RingTable, ExportError> {
    if nodes < 3 {
        return Err(ExportError::refused("nodes", "a table has three nodes or more"));
    }
    let thetas: Vec<f64> = (0..nodes).map(|k| 90.0 * k as f64 / (nodes - 1) as f64).collect();
    // As in the program: the row of the horizon is that of 89°.
    let thetai = thetas.iter().map(|theta| theta.min(89.0)).collect();
    let grid = GridRequest { thetai, thetas, phis: vec![0.0], patch: GridPatch::Ring };
    let request = TableRequest {
        material: String::new(),
        what: What::Grid(grid),
        wavelengths: wavelengths.to_vec(),
        settings: ColourNames::default().settings(None)?,
        incident: [1.0, 0.0, 0.0, 0.0],
        stokes: true,
        basis: Basis::Psps,
        sampling: default_sampling(),
        limits: Limits::default(),
    };
    let own = Control { cancel: control.cancel.clone(), progress: None };
    let table = table::table(material, &request, &own)?;
    let sign = match filter {
        None => 0.0,
        Some(Filter::S) => 1.0,
        Some(Filter::P) => -1.0,
    };
    let behind =
        |row: &ColourRow| into_gamut(std::array::from_fn(|c| row.rgb[0][c] + sign * row.rgb[1][c]));
    RingTable::new(nodes, table.rows.iter().map(behind).collect())
}

/// The scenes that show the tables.
fn scenes(
    text: &str,
    stem: &str,
    chunks: &[Chunk],
    materials: &[Described],
    shown: &[Shown],
    made: &mut Made,
) {
    let scene = |tag: &str, made: &Made, pick: &dyn Fn(&Shown) -> String, only_exr: bool| {
        let mut pieces: Vec<_> = materials
            .iter()
            .zip(shown)
            .map(|(material, shown)| {
                let file = pick(shown);
                let rho = made.tables[&file].reflectance();
                (chunks[material.chunk].span.clone(), composite(&material.name, &file, rho))
            })
            .collect();
        let outputs: Vec<&Chunk> =
            chunks.iter().filter(|chunk| chunk.keyword == "file_rasterizeroutput").collect();
        for (number, output) in outputs.iter().enumerate() {
            let new = match (only_exr, number) {
                (true, 0) => exr_output(stem, tag),
                (true, _) => String::new(),
                (false, _) => renamed(output, tag),
            };
            pieces.push((output.span.clone(), new));
        }
        replaced(text, pieces)
    };
    let plain = scene("mist", made, &|shown| shown.plain.clone(), false);
    let add = |made: &mut Made, tag: &str, text: String| {
        let file = format!("{stem}_{tag}.RISEscene");
        made.scenes.push(file.clone());
        made.text(&file, text);
    };
    add(made, "mist", plain);
    if shown.iter().any(|shown| shown.filtered.is_some()) {
        let pick = |shown: &Shown| shown.filtered.clone().unwrap_or_else(|| shown.plain.clone());
        let text = scene("mist_pol", made, &pick, false);
        add(made, "mist_pol", text);
    }
    let bands = shown.iter().map(|shown| shown.bands.len()).max().unwrap_or(0);
    for band in 0..bands {
        let tag = format!("b{band:02}");
        let text = scene(&tag, made, &|shown| shown.bands[band].clone(), true);
        add(made, &tag, text);
        made.bands.push(format!("{stem}_{tag}.exr"));
    }
}

/// A material that shows a table and bounces light as a Lambertian body.
fn composite(name: &str, file: &str, [r, g, b]: [f64; 3]) -> String {
    format!(
        "# the table of {name}, and a diffuse body of its reflectance for light that bounces on\n\
         uniformcolor_painter\n{{\n\tname\t{name}_rho\n\tcolor\t{r:.6} {g:.6} {b:.6}\n}}\n\n\
         lambertian_material\n{{\n\tname\t{name}_body\n\treflectance\t{name}_rho\n}}\n\n\
         datadriven_material\n{{\n\tname\t{name}_table\n\tfilename\t{file}\n}}\n\n\
         composite_material\n{{\n\tname\t{name}\n\ttop\t{name}_table\n\tbottom\t{name}_body\n}}\n"
    )
}

/// One linear EXR with 32 bits, for images that are added up.
fn exr_output(stem: &str, tag: &str) -> String {
    format!(
        "file_rasterizeroutput\n{{\n\tpattern\t{stem}_{tag}\n\ttype\tEXR\n\tbpp\t32\n\
         \tcolor_space\tRec709RGB_Linear\n\texr_with_alpha\tFALSE\n}}\n"
    )
}

/// The same output under the name of the scene it belongs to.
fn renamed(output: &Chunk, tag: &str) -> String {
    let mut text = format!("{}\n{{\n", output.keyword);
    for (name, value) in &output.lines {
        let value = if name == "pattern" {
            let last = value.rsplit(['/', '\\']).next().unwrap_or(value);
            format!("{last}_{tag}")
        } else {
            value.clone()
        };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "\t{name}\t{value}");
    }
    text + "}\n"
}

/// The images that a scene writes: name without folder, extension.
///
/// # Errors
///
/// For texts that are not a scene.
pub fn images(scene: &str) -> Result<Vec<String>, ExportError> {
    let chunks = chunks(scene)?;
    let outputs = chunks.iter().filter(|chunk| chunk.keyword == "file_rasterizeroutput");
    Ok(outputs
        .map(|output| {
            let extension = output.get("type").unwrap_or("PNG").to_ascii_lowercase();
            format!("{}.{extension}", output.get("pattern").unwrap_or("rendered"))
        })
        .collect())
}
