//! A fit of a slope to a scan of facets, and the values of a program with numbers from memory.

use std::sync::Arc;

use mist_engine::{
    Control, MemoryFiles, Options, compile,
    fit::{FitSettings, MeasuredTable, fit},
    function::ProgramFunction,
};

const PROGRAM: &str = include_str!("fit_facet/scan.mist");
const MEASURED: &str = include_str!("fit_facet/scan.csv");

fn function(source: &str) -> ProgramFunction {
    let files = Arc::new(MemoryFiles::default());
    ProgramFunction::new(source, files, Options::default(), &["#sdf.s".to_owned()]).unwrap()
}

#[test]
fn a_slope_is_found_from_a_wrong_start() {
    let program = function(PROGRAM);
    let measured = MeasuredTable::parse(MEASURED, program.titles(), program.headers()).unwrap();
    for start in [0.1, 0.3] {
        let start = [("#sdf.s".to_owned(), start)].into();
        let settings = FitSettings { start, ..FitSettings::default() };
        let found = fit(&program, &measured, &settings, &Control::default()).unwrap();
        // The measured values have eight digits.
        assert!((found.parameters[0].value - 0.2).abs() < 1e-7, "{found:?}");
        assert!(found.runs <= 4 * found.iterations + 8, "{found:?}");
    }
}

#[test]
fn values_from_memory_give_the_rows_of_values_in_the_text() {
    let program = function(PROGRAM);
    // 1/3 needs all bits: sixteen digits give another number.
    for s in [0.2, 0.25, 1.0 / 3.0] {
        let source = PROGRAM.replace("#sdf.s = 0.2", &format!("#sdf.s = {s:?}"));
        let control = Control::default();
        let expected = function(&source).run(&[s], &control).unwrap().rows;
        let found = program.run(&[s], &control).unwrap().rows;
        assert_eq!(found, expected);
        let outputs = program.outputs(&[s], &control).unwrap().rows;
        let numbers = |rows: &[mist_engine::function::OutputRow]| -> Vec<u64> {
            rows.iter().flat_map(|row| row.outputs.iter().map(|x| x.to_bits())).collect()
        };
        assert_eq!(numbers(&outputs), numbers(&found));
    }
}

#[test]
fn a_job_keeps_other_values_apart_from_its_own() {
    let files = Arc::new(MemoryFiles::default());
    let job = compile(PROGRAM, files, &Options::default()).unwrap();
    let slope = job.variable("sdf.s").unwrap();
    assert_eq!((slope.name(), slope.value()), ("#sdf.s", 0.2));
    let other = job.with_values(std::slice::from_ref(&slope), &[0.3]).unwrap();
    let results = |job: &mist_engine::Job| {
        let mut sink = mist_engine::MemorySink::default();
        job.run(&mut sink, &Control::default()).unwrap();
        sink.results
    };
    assert_ne!(results(&job), results(&other));
    let back = other.with_values(&[slope], &[0.2]).unwrap();
    assert_eq!(results(&job), results(&back));
}
