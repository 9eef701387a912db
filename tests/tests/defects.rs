//! Defects of NIST's program outside of single models, in both modes.

use std::{collections::BTreeMap, sync::Arc};

use mist_engine::{Control, MemoryFiles, MemorySink, Options, RunSummary, compile};
use scattering::{Defect, Mode};

/// The last number of the results, and the summary of the run.
fn run(program: &str, mode: Mode) -> (f64, RunSummary) {
    let files = [
        ("gold.txt", "; n, k\n0.4 2.0 0.0\n0.7 2.0 0.0\n"),
        ("/gold.txt", "; n, k\n0.4 3.0 0.0\n0.7 3.0 0.0\n"),
        ("./gold.txt", "; n, k\n0.4 2.0 0.0\n0.7 2.0 0.0\n"),
    ];
    let files: BTreeMap<String, Arc<str>> =
        files.into_iter().map(|(name, text)| (name.to_owned(), text.into())).collect();
    let options = Options { mode, ..Options::default() };
    let job = compile(program, Arc::new(MemoryFiles(files)), &options)
        .unwrap_or_else(|diagnostics| panic!("{diagnostics:?} in\n{program}"));
    let mut sink = MemorySink::default();
    let summary = job.run(&mut sink, &Control::default()).unwrap();
    let last = sink.results.split_whitespace().last().unwrap().parse().unwrap();
    (last, summary)
}

/// Facets lit at 70°, seen in `shape`; `settings` are more variables.
fn program(settings: &str, shape: &str) -> String {
    format!(
        "MODEL = Facet_BRDF_Model\n\
         VARIABLES:\n pi = 4*atan(1)\n deg = pi/180\n minsamples = 1\n incidentangle = 70*deg\n incidentpol = (1,0,0,0)\n rotation = 0\n \
         #lambda = 0.5\n $sdf = Gaussian_Slope_Distribution_Function\n #sdf.s = 0.3\n {settings}\nEND\nVARY:\nEND\n\
         INTEGRALS:\n R = {shape}\n INPOL = (1,0,0,0)\n END\nEND\n\
         OUTPUTS:\n 1 seen=R\nEND\nFILES:\n format = %.15le\\t\nEND\n"
    )
}

#[test]
fn the_hemisphere_of_nists_program_lacks_directions_however_fine_its_grid() {
    let fine = |steps: &str| program(&format!("differential = ({steps}*deg)^2"), "HEMI");
    let (sound, summary) = run(&fine("1"), Mode::Sound);
    assert!(summary.met.contains(&Defect::PolygonHorizon.into()));
    let (finer, _) = run(&fine("0.5"), Mode::Sound);
    // The sum has converged to 4·10⁻⁴, that over the polygon to 3·10⁻³ less.
    assert!((sound / finer - 1.0).abs() < 1e-3, "{sound} {finer}");
    for steps in ["1", "0.5"] {
        let (compat, summary) = run(&fine(steps), Mode::Compat);
        assert!(summary.met.is_empty());
        let missing = 1.0 - compat / finer;
        assert!(missing > 2e-3 && missing < 5e-3, "{missing:e}");
    }
}

#[test]
fn a_direction_has_no_horizon_to_speak_of() {
    let point = program("differential = 1", "DIFFERENTIAL\n CENTER = (50*deg,0)\n POL = (1,0,0,0)");
    let ((sound, summary), (compat, _)) = (run(&point, Mode::Sound), run(&point, Mode::Compat));
    assert!(summary.met.is_empty(), "{:?}", summary.met);
    assert!((sound / compat - 1.0).abs() < 1e-9);
}

#[test]
fn a_file_in_the_current_folder_is_read_soundly_and_loses_its_dot_in_compat() {
    let of = |substrate: &str| {
        let settings = format!("differential = 1\n $substrate = {substrate}");
        program(&settings, "DIFFERENTIAL\n CENTER = (50*deg,0)\n POL = (1,0,0,0)")
    };
    let (two, three) = (run(&of("(2,0)"), Mode::Sound).0, run(&of("(3,0)"), Mode::Sound).0);
    let (sound, summary) = run(&of("./gold.txt"), Mode::Sound);
    assert!(summary.met.contains(&Defect::IndexText.into()));
    let (compat, _) = run(&of("./gold.txt"), Mode::Compat);
    // Sound reads n = 2 from the file named, compat n = 3 from /gold.txt.
    assert!((sound / two - 1.0).abs() < 1e-12 && (compat / three - 1.0).abs() < 1e-9);
    let (_, summary) = run(&of("gold.txt"), Mode::Sound);
    assert!(summary.met.is_empty(), "{:?}", summary.met);
}
