//! Loops of any length need the memory of one block of steps.
//!
//! The only test of its binary, because it measures the memory of the whole process.

use std::{collections::BTreeMap, fmt::Write as _, io, sync::Arc};

use mist_engine::{Control, Failure, Limits, MemoryFiles, Options, OutputStream, Sink, compile};

/// A program with the loops `vary`.
fn text(vary: &str) -> String {
    format!(
        "MODEL = Lambertian_BRDF_Model\nVARIABLES:\n a = 1  x = 1\n incidentangle = 0.5  \
         incidentpol = (1,0,0,0)  rotation = 0  differential = 0.01  minsamples = 1\nEND\n\
         VARY: {vary} END\nINTEGRALS: R = DIFFERENTIAL CENTER=(0.1,0) END END\n\
         OUTPUTS: 1 R*a END\nFILES: END\n"
    )
}

/// Counts rows without storing them.
#[derive(Default)]
struct Counter {
    bytes: usize,
}

impl Sink for Counter {
    fn write(&mut self, _: OutputStream, text: &str) -> io::Result<()> {
        self.bytes += text.len();
        Ok(())
    }
}

/// Memory of this process in MiB; `None` if the platform does not report it.
fn held() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmRSS:"))?;
    let kib: f64 = line.split_ascii_whitespace().nth(1)?.parse().ok()?;
    Some(kib / 1024.0)
}

/// Runs the loops `vary` up to `steps` steps.
fn run_up_to(steps: u64, vary: &str, files: MemoryFiles) -> (Result<(), Failure>, usize) {
    let limits = Limits { steps, ..Limits::default() };
    let options = Options { limits, ..Options::default() };
    let job = compile(&text(vary), Arc::new(files), &options).unwrap();
    let mut counter = Counter::default();
    let done = job.run(&mut counter, &Control::default()).map(|_| ());
    (done, counter.bytes)
}

/// More than the buffers of one block of steps, less than a hundred thousand stored rows.
const FLAT_MIB: f64 = 24.0;

/// A loop of a billion steps, up to the limit.
fn a_long_loop_stays_flat() {
    let vary = "FOR a FROM 1 TO 1e9 BY 1";
    let (done, _) = run_up_to(2_000, vary, MemoryFiles::default());
    assert!(matches!(done, Err(Failure::Limit(_))), "{done:?}");
    let before = held();
    let (done, bytes) = run_up_to(60_000, vary, MemoryFiles::default());
    let Err(Failure::Limit(why)) = done else { panic!("{done:?}") };
    assert!(why.contains("more than 60000 steps"), "{why}");
    assert!(bytes > 1_000_000, "the rows up to there were handed on, {bytes} bytes");
    grows_by_less_than(before, FLAT_MIB);
}

/// A LIST of a million rows, whose first rows are run.
fn a_long_list_is_kept_once() {
    let mut rows = "a x\n".to_owned();
    for row in 0..1_000_000 {
        writeln!(rows, "{row} {}", row % 7).unwrap();
    }
    // The text, and sixteen bytes for each of two million cells, in a list that doubles.
    let list = (rows.len() + 2 * 2_000_000 * 16) as f64 / f64::from(1 << 20);
    let files = MemoryFiles(BTreeMap::from([("rows".to_owned(), Arc::from(rows))]));
    let before = held();
    let (done, bytes) = run_up_to(60_000, "LIST rows", files);
    assert!(matches!(done, Err(Failure::Limit(_))), "{done:?}");
    assert!(bytes > 1_000_000, "{bytes} bytes");
    grows_by_less_than(before, list + FLAT_MIB);
}

fn grows_by_less_than(before: Option<f64>, most: f64) {
    if let (Some(before), Some(after)) = (before, held()) {
        assert!(after - before < most, "{before} MiB became {after} MiB, allowed were {most} more");
    }
}

#[test]
fn steps_are_streamed_in_flat_memory() {
    assert!(Limits::default().steps <= 1_000_000_000);
    a_long_loop_stays_flat();
    a_long_list_is_kept_once();
}
