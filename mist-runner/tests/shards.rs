//! Shards run and merged by the library give the files of one run.

use std::{fs, path::Path, sync::Arc};

use mist_engine::{Control, Job, MemoryFiles, Options, compile};
use mist_runner::{
    merge::{MergeError, merge},
    run::{run_shard, run_to_files},
    shard::Shard,
};

const PROGRAM: &str = "MODEL = Lambertian_BRDF_Model\nVARIABLES:\n\
    rad = atan(1)/45 thetai = 0 incidentangle = thetai*rad incidentpol = (1,0,0,0) rotation = 0\n\
    differential = (5*rad)^2 minsamples = 10 END\n\
    VARY:\nFOR thetai FROM 0 TO 60 BY 10\nEND\n\
    INTEGRALS: R = CIRCLE CENTER = (0,0) ALPHA = 10*deg END END\nOUTPUTS: 1 f=R END\n\
    FILES: END\n";

fn job(options: &Options) -> Job {
    let files = Arc::new(MemoryFiles::default());
    compile(PROGRAM, files, options).unwrap_or_else(|found| panic!("{found:?}"))
}

/// The rows of numbers of a table.
fn rows(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap();
    text.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit())).collect()
}

#[test]
fn shards_of_a_job_merge_into_its_table() {
    let folder = tempfile::tempdir().unwrap();
    let options = Options { job: "scan".into(), ..Options::default() };
    let (job, control) = (job(&options), Control::default());
    let (summary, whole) = run_to_files(&job, folder.path(), &control).unwrap();

    let shards: Vec<_> = (1..=3)
        .map(|number| {
            let shard = Shard { number, of: 3 };
            let run = run_shard(&job, (&options, PROGRAM), shard, folder.path(), &control);
            let run = run.unwrap();
            assert_eq!((run.job_steps, run.steps_before), (summary.steps, 0));
            run.path
        })
        .collect();
    let missing = merge(&shards[1..], None).unwrap_err();
    assert!(matches!(&missing, MergeError::Missing(names) if names == &["scan.1-of-3"]));

    let table = folder.path().join("merged.dat");
    let merged = merge(&shards, Some(&table)).unwrap();
    assert_eq!((merged.job.as_str(), merged.steps), ("scan", summary.steps));
    let results = whole.iter().find(|file| file.title == "results").unwrap();
    assert_eq!(rows(&table), rows(&results.path));
    assert!(!rows(&table).is_empty());
}
