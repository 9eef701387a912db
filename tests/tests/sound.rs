//! What sound runs do with the conformance programs.

use mist_engine::Failure;
use mist_tests::{
    compare::{Tolerance, tables},
    corpus::{self, Case},
};
use rayon::prelude::*;
use scattering::Mode;

fn cases(area: &str) -> Vec<Case> {
    let all = corpus::cases(&corpus::folder());
    all.into_iter().filter(|case| case.area.starts_with(area) && case.kind == "ok").collect()
}

#[test]
fn a_sound_run_gives_a_table_or_says_what_to_change() {
    let folder = corpus::folder();
    let silent: Vec<String> = cases("")
        .par_iter()
        .filter_map(|case| match corpus::run(&folder, case, Mode::Sound) {
            Ok(_) => None,
            Err(Failure::Program(diagnostics)) => diagnostics
                .iter()
                .find(|d| d.help.is_none() && d.notes.is_empty())
                .map(|d| format!("{}: {d}", case.name)),
            Err(other) => Some(format!("{}: {other}", case.name)),
        })
        .collect();
    assert!(silent.is_empty(), "refusals without help:\n{}", silent.join("\n"));
}

#[test]
fn directions_of_models_without_defects_are_the_same_in_both_modes() {
    // No apertures, no defect: what differs is below 1e-9 by the definition of
    // `Defect::is_noticeable`, of the largest output of the row.
    let folder = corpus::folder();
    let tolerance = Tolerance { relative: 1e-9, of_row: 1e-9, header_lines: 1, loop_columns: 0 };
    for name in ["v_shape_differential", "v_spec_color_table", "v_micro_abc"] {
        let case = cases("").into_iter().find(|case| case.name == name).expect("it is there");
        let run =
            |mode| corpus::run(&folder, &case, mode).unwrap_or_else(|e| panic!("{name}: {e}"));
        let (sound, summary) = run(Mode::Sound);
        assert!(summary.met.is_empty(), "{name} meets {:?}", summary.met);
        tables(&sound.results, &run(Mode::Compat).0.results, tolerance).unwrap();
    }
}
