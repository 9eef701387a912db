//! Conformance programs in sound mode.

use std::{collections::BTreeMap, sync::Arc};

use mist_engine::{Control, Failure, MemoryFiles, MemorySink, Options};
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
        // Rows of compat runs end in a tab.
        let compat = run(Mode::Compat).0.results.replace("\t\n", "\n");
        tables(&sound.results, &compat, tolerance).unwrap();
    }
}

#[test]
fn the_end_of_a_loop_belongs_to_it_whatever_its_steps_are_rounded_to() {
    let text = |vary: &str| {
        format!(
            "MODEL = Lambertian_BRDF_Model VARIABLES: a = 0 incidentangle = 0 rotation = 0 \
             incidentpol = (1,0,0,0) differential = 1 minsamples = 1 END VARY: {vary} END \
             INTEGRALS: END OUTPUTS: 1 b=a END FILES: END "
        )
    };
    for (vary, rows) in [
        ("FOR a FROM 0 TO 0.3 BY 0.1", 4),
        ("FOR a FROM 0.3 TO 0 BY -0.1", 4),
        ("FOR a FROM -0.1 TO -0.3 BY -0.1", 3),
        ("FOR a FROM 1 TO 2 BY 0.7", 2),
    ] {
        let results = results(&text(vary), Mode::Sound, &[]);
        assert_eq!(results.lines().count(), rows + 1, "{vary}: {results}");
    }
}

#[test]
fn variables_of_variables_follow_a_loop_however_far_they_are_from_it() {
    let program = "MODEL = Lambertian_BRDF_Model VARIABLES: a = 0 k = 3 b = 2*a c = b+k d = c*b \
         incidentangle = 0 rotation = 0 incidentpol = (1,0,0,0) differential = 1 minsamples = 1 \
         END VARY: FOR a FROM 1 TO 4 BY 1 END INTEGRALS: END OUTPUTS: 1 e=d+c END FILES: END ";
    let table = results(program, Mode::Sound, &[]);
    let last = |line: &str| line.split_whitespace().last().unwrap().parse::<f64>().unwrap();
    let got: Vec<f64> = table.lines().skip(1).map(last).collect();
    let want = [1.0, 2.0, 3.0, 4.0].map(|a| (2.0 * a + 3.0) * (2.0 * a + 1.0));
    assert_eq!(got, want, "{table}");
}

#[test]
fn a_variable_that_is_given_again_from_itself_begins_anew_in_every_step() {
    let program = "MODEL = Lambertian_BRDF_Model VARIABLES: a = 0 q = 0 m = 1 m = m+a m = m*m \
         incidentangle = 0 rotation = 0 incidentpol = (1,0,0,0) differential = 1 minsamples = 1 \
         END VARY: FOR q FROM 0 TO 1 BY 1 FOR a FROM 0 TO 3 BY 1 END INTEGRALS: END \
         OUTPUTS: 1 e=m END FILES: END ";
    let table = results(program, Mode::Sound, &[]);
    let last = |line: &str| line.split_whitespace().last().unwrap().parse::<f64>().unwrap();
    let got: Vec<f64> = table.lines().skip(1).map(last).collect();
    let want = [0.0, 1.0, 2.0, 3.0].map(|a: f64| (1.0 + a).powi(2));
    assert_eq!(got[4..], want, "{table}");
}

#[test]
fn a_new_slope_distribution_gets_its_parameters_again_in_a_sound_run_only() {
    let program = "MODEL = Facet_BRDF_Model VARIABLES: \
         $sdf = Gaussian_Slope_Distribution_Function #sdf.s = 0.2 \
         incidentangle = 0.3 rotation = 0 incidentpol = (1,0,0,0) differential = 1 \
         minsamples = 1 END VARY: LIST slopes.lst END \
         INTEGRALS: f = DIFFERENTIAL CENTER = (0.1,0) END END OUTPUTS: 1 f END FILES: END ";
    let slopes = "$sdf\nGaussian_Slope_Distribution_Function\n\
         Exponential_Slope_Distribution_Function\nGaussian_Slope_Distribution_Function\n";
    let value = |mode, row: usize| {
        let table = results(program, mode, &[("slopes.lst", slopes)]);
        let line = table.lines().nth(row).expect("a row for every line of the list").to_owned();
        line.split_whitespace().last().expect("a value").to_owned()
    };
    assert_eq!(value(Mode::Sound, 1), value(Mode::Sound, 3));
    assert_eq!(value(Mode::Sound, 1), value(Mode::Compat, 1));
    assert_ne!(value(Mode::Compat, 1), value(Mode::Compat, 3), "a new object has its defaults");
}

/// The table of a program with its `files`.
fn results(program: &str, mode: Mode, files: &[(&str, &str)]) -> String {
    let files: BTreeMap<_, _> =
        files.iter().map(|(name, text)| ((*name).to_owned(), Arc::from(*text))).collect();
    let options = Options { mode, ..Options::default() };
    let job = mist_engine::compile(program, Arc::new(MemoryFiles(files)), &options);
    let mut sink = MemorySink::default();
    job.unwrap().run(&mut sink, &Control::default()).unwrap();
    sink.results
}
