//! A fit of a slope to a scan of facets, and the values of a program with numbers from memory.

use std::sync::Arc;

use mist_engine::{
    Control, MemoryFiles, Options, OutputStream, Sink, TableLine, compile,
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

/// The numbers of the outputs, by their bits.
#[derive(Default)]
struct OutputBits(Vec<u64>);

impl Sink for OutputBits {
    fn write(&mut self, _: OutputStream, _: &str) -> std::io::Result<()> {
        Ok(())
    }

    fn row(&mut self, line: &TableLine) -> std::io::Result<()> {
        self.0.extend(line.outputs().iter().map(|x| x.to_bits()));
        Ok(())
    }
}

/// Loops over the class of the slopes, the angle and the wavelength; `SLOPE` and `EXPRESSION` are replaced.
const LOOPS: &str = "
MODEL = Facet_BRDF_Model
VARIABLES:
  deg0 = atan(1)/45  slope = 0.2  half = slope/2  thetas = 30  lambda = 0.5
  incidentangle = 30*deg0  incidentpol = (1,0,0,0)  rotation = 0  differential = 1  minsamples = 1
  #lambda = lambda  #substrate = 1.4+0.1/lambda
  $sdf = Gaussian_Slope_Distribution_Function
  #sdf.s = SLOPE
END
VARY:
  LIST slopes
  FOR thetas FROM 0 TO 60 BY 30
  FOR lambda FROM 0.4 TO 0.7 BY 0.1
END
INTEGRALS:
  f = DIFFERENTIAL CENTER = (thetas*deg0,0) END
  h = CIRCLE CENTER = (thetas*deg0,0) ALPHA = 5*deg0 END
END
OUTPUTS:
  1 EXPRESSION
END
FILES: END
";

#[test]
fn every_run_of_a_function_gives_the_numbers_of_a_new_job() {
    let list =
        "$sdf\nGaussian_Slope_Distribution_Function\nExponential_Slope_Distribution_Function\n";
    let files = Arc::new(MemoryFiles([("slopes".to_owned(), list.into())].into()));
    // Only the first program has steps that serve all runs.
    for (slope, output) in
        [("2*half", "a=f+h"), ("2*half", "a=f+h+slope"), ("half*thetas/30+0.1", "a=f+h")]
    {
        let source = LOOPS.replace("SLOPE", slope).replace("EXPRESSION", output);
        let options = Options::default();
        let names = ["slope".to_owned()];
        let function =
            ProgramFunction::new(&source, files.clone(), options.clone(), &names).unwrap();
        for value in [0.2, 0.1, 1.0 / 3.0, 0.2] {
            let changed = source.replace("slope = 0.2", &format!("slope = {value:?}"));
            let job = compile(&changed, files.clone(), &options).unwrap();
            let mut expected = OutputBits::default();
            job.run(&mut expected, &Control::default()).unwrap();
            assert_eq!(expected.0.len(), 24);
            let found = function.outputs(&[value], &Control::default()).unwrap().rows;
            let found: Vec<u64> =
                found.iter().flat_map(|row| &row.outputs).map(|x| x.to_bits()).collect();
            assert_eq!(found, expected.0, "{slope} {output} {value}");
        }
    }
}
