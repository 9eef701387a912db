//! One material, four patches: the colour tables of the program, of the material as JSON and of
//! the results file agree with each other and with a table of other programs.
//!
//! The integrals of `mtab/orange_paint.mtab` come from NIST's MIST, its colours from
//! colour-science.

use std::{fs, path::PathBuf, sync::Arc};

use mist_engine::{
    Control, FileError, Files, Limits, MemorySink, Options,
    colour::ColourTable,
    compile,
    material::{
        Material,
        results::{self, ResultColumns},
        table::table,
    },
    request::{ColourQuery, PatchList, TableDirections, TableRequest, Wavelengths},
    sampling::{Outlines, PlaneSampling},
};
use scattering::{Basis, Mode};

struct Folder;

impl Files for Folder {
    fn read(&self, name: &str) -> Result<Arc<str>, FileError> {
        fs::read_to_string(folder().join(name))
            .map(Arc::from)
            .map_err(|e| FileError { name: name.into(), reason: e.to_string() })
    }
}

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("mtab")
}

fn text(name: &str) -> String {
    fs::read_to_string(folder().join(name)).expect("the file is in the repository")
}

fn golden() -> ColourTable {
    rise_bridge::read::mtab(&text("orange_paint.mtab")).expect("the golden table is whole")
}

/// The program's own table and its results file.
fn of_program() -> (ColourTable, String) {
    let options = Options { mode: Mode::Compat, job: "orange_paint".into(), ..Options::default() };
    let job = compile(&text("orange_paint.mist"), Arc::new(Folder), &options).unwrap();
    let mut sink = MemorySink::default();
    let summary = job.run(&mut sink, &Control::default()).unwrap();
    (summary.colour.expect("the program has a section COLOR"), sink.results)
}

fn of_material(mode: Mode, outlines: Outlines) -> ColourTable {
    let material = Material::from_json(&text("orange_paint.json")).unwrap();
    let prepared = material.prepare(mode, Some(Arc::new(Folder))).unwrap();
    let request = TableRequest {
        material: "orange_paint".into(),
        directions: TableDirections::List(text("patches.lst").parse::<PatchList>().unwrap().0),
        wavelengths: "360:10:750".parse::<Wavelengths>().unwrap().into_vec(),
        settings: ColourQuery::default().settings(None).unwrap(),
        incident: [1.0, 0.0, 0.0, 0.0],
        stokes: true,
        basis: Basis::Psps,
        sampling: Some(PlaneSampling { outlines, ..PlaneSampling::default() }),
        limits: Limits::default(),
    };
    table(&prepared, &request, &Control::default()).unwrap()
}

fn assert_same(got: &ColourTable, want: &ColourTable, tolerance: f64) {
    assert_eq!(got.rows.len(), want.rows.len());
    assert_eq!((got.stokes, &got.patch, &got.leading), (want.stokes, &want.patch, &want.leading));
    for (a, b) in got.rows.iter().zip(&want.rows) {
        assert_eq!((a.thetai, a.thetas, a.phis, a.flags), (b.thetai, b.thetas, b.phis, b.flags));
        let numbers = |row: &mist_engine::colour::ColourRow| {
            let colours = row
                .rgb
                .iter()
                .zip(&row.xyz)
                .flat_map(|(rgb, xyz)| [rgb[0], rgb[1], rgb[2], xyz[1]]);
            std::iter::once(row.omega).chain(colours).collect::<Vec<f64>>()
        };
        for (x, y) in numbers(a).into_iter().zip(numbers(b)) {
            assert!((x - y).abs() <= tolerance, "{x} is not {y}: {a:?}");
        }
    }
}

#[test]
fn the_program_gives_the_golden_table() {
    let (table, _) = of_program();
    // The golden table has nine digits.
    assert_same(&table, &golden(), 1e-8);
    assert_eq!(table.wavelengths.len(), 40);
    assert_eq!((table.illuminant.as_str(), table.space.as_str()), ("D65", "sRGB"));
}

#[test]
fn the_material_gives_the_golden_table_with_the_apertures_of_the_program() {
    assert_same(&of_material(Mode::Compat, Outlines::Polygons { sides: 360 }), &golden(), 1e-8);
}

#[test]
fn exact_apertures_and_sound_physics_change_little() {
    // A polygon with 360 sides drops a few points next to the rim of a cone of about 100, and
    // light recycled in the body is integrated instead of summed: 1e-4 of the largest value.
    assert_same(&of_material(Mode::Sound, Outlines::Exact), &golden(), 1e-4 * 0.45);
}

#[test]
fn the_results_file_gives_the_golden_table() {
    let (_, results) = of_program();
    let columns = ResultColumns::parse("wl:nm", "f0,f1,f2,f3").unwrap();
    let settings = ColourQuery::default().settings(None).unwrap();
    let light = ([1.0, 0.0, 0.0, 0.0], "psps");
    let table = results::table(&results, &columns, "orange_paint", &settings, light).unwrap();
    assert_same(&table, &golden(), 1e-8);
}

#[test]
fn a_results_file_without_the_column_is_refused_by_its_name() {
    let columns = ResultColumns::parse("wl:nm", "f9").unwrap();
    let settings = ColourQuery::default().settings(None).unwrap();
    let light = ([1.0, 0.0, 0.0, 0.0], "psps");
    let error = results::table("wl\tf0\t\n400\t1\t\n", &columns, "x", &settings, light);
    assert!(error.unwrap_err().to_string().contains("f9"));
}
