//! Programs with independent steps, and programs without.

use std::sync::Arc;

use rayon::ThreadPoolBuilder;
use scattering::Mode;

use crate::{
    Control, Job, MemoryFiles, MemorySink, Options, OutputStream, compile, replay::Replay,
};

/// A program of directions with these VARIABLES, loops and outputs.
fn program(variables: &str, loops: &str, outputs: &str) -> String {
    format!(
        "MODEL = Facet_BRDF_Model\nVARIABLES:\n rad = atan(1)/45 x = 0 y = 0 incidentangle = x*rad \
         incidentpol = (1,0,0,0) rotation = 0 differential = 1 minsamples = 1\n{variables}\n\nEND\n\
         VARY:\n{loops}\nEND\nINTEGRALS:\n f = DIFFERENTIAL CENTER = (y*rad,0.3) END\nEND\n\
         OUTPUTS:\n{outputs}\nEND\nFILES: format = %.17g\\t END\n"
    )
}

const LOOPS: &str = "FOR x FROM 1 TO 40 BY 3\n FOR y FROM -20 TO 70 BY 5.5";
const SDFS: &str = "$sdf\nGaussian_Slope_Distribution_Function\nUnit_Slope_Distribution_Function\n";
const CELLS: &str = "x\ty\n0.1*y\t2\n0.2\t3\n0.3\t4\n";
const OUTPUTS: &str = "1 f\n2 f*x";

fn job(source: &str) -> Job {
    let files = [("sdfs.txt", SDFS), ("cells.txt", CELLS)];
    let files = MemoryFiles(files.map(|(name, text)| (name.to_owned(), Arc::from(text))).into());
    let options = Options { mode: Mode::Compat, ..Options::default() };
    compile(source, Arc::new(files), &options).unwrap_or_else(|faults| panic!("{faults:?}"))
}

/// The table and the listing without the time it took.
fn texts(sink: &MemorySink) -> (&str, &str) {
    let listing = sink.listing.rsplit_once("Elapsed").map_or("", |(before, _)| before);
    (&sink.results, listing)
}

fn run(job: &Job, threads: usize) -> MemorySink {
    let mut sink = MemorySink::default();
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| job.run(&mut sink, &Control::default())).unwrap_or_else(|e| panic!("{e:?}"));
    sink
}

fn is_independent(job: &Job) -> bool {
    let mut replay = Replay::new(job);
    replay.next_step().unwrap();
    job.graph.independence.as_ref().is_some_and(|all| all.holds_for(replay.parameters()))
}

/// Programs and whether their steps are independent.
fn programs() -> Vec<(String, bool)> {
    let gaussian = "$sdf = Gaussian_Slope_Distribution_Function";
    let with = |variables: &str| program(variables, LOOPS, OUTPUTS);
    vec![
        (with(&format!("{gaussian}\n #sdf.s = 0.2+y/200\n #lambda = 0.5")), true),
        (with("s = 0.2+x/100\n #lambda = s\n $substrate = (1.5,0)"), true),
        // A setting of optical constants outlives other texts for them.
        (with("#substrate.n = 1.5+x/100"), false),
        // A variable that is given twice.
        (
            with(&format!(
                "early = 1\n late = early\n early = y/300\n {gaussian}\n #sdf.s = 0.2+early^2*late"
            )),
            false,
        ),
        // The distribution comes behind its width.
        (with(&format!("#sdf.s = 0.1+y*y/9000\n {gaussian}")), false),
        // A new distribution forgets its width.
        (
            program(
                "$sdf = Unit_Slope_Distribution_Function\n #sdf.s = 0.2",
                "FOR x FROM 1 TO 60 BY 1\n LIST sdfs.txt",
                OUTPUTS,
            ),
            false,
        ),
        // Bounds that follow a loop, and cells that do.
        (program("", "FOR x FROM 1 TO 30 BY 1\n FOR y FROM 0 TO x BY 2", OUTPUTS), false),
        (program("z = 0", "FOR z FROM 1 TO 40 BY 1\n LIST cells.txt", OUTPUTS), false),
    ]
}

#[test]
fn independent_steps_are_recognised() {
    for (source, alone) in programs() {
        assert_eq!(is_independent(&job(&source)), alone, "{source}");
    }
}

#[test]
fn parallel_replays_give_the_table_and_the_listing_of_one_replay() {
    for (source, _) in programs() {
        let job = job(&source);
        let one = run(&job, 1);
        assert!(one.results.lines().count() > 100, "{source}");
        for threads in [2, 3, 5] {
            let several = run(&job, threads);
            assert!(texts(&one) == texts(&several), "{source}");
        }
    }
}

#[test]
fn a_part_from_the_middle_is_a_part_of_the_whole() {
    for (source, _) in programs() {
        let job = job(&source);
        let steps = job.count_steps(&Control::default()).unwrap();
        let mut results = job.head(OutputStream::Results);
        for part in [0..1, 1..2, 2..97, 97..steps] {
            let mut sink = MemorySink::default();
            job.run_part(part, &mut sink, &Control::default()).unwrap();
            results.push_str(&sink.results);
        }
        assert!(results == run(&job, 1).results, "{source}");
    }
}
