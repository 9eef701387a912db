//! Every program of `tests/suite` is a test of its own, named after its file.
//!
//!     cargo test --release -p mist-tests --test suite            all programs
//!     cargo test --release -p mist-tests --test suite language   those with this in their names
//!
//! `tests/README.md` says how to write one.

use std::{fs, path::Path, process::ExitCode};

use libtest_mimic::{Arguments, Failed, Trial};
use mist_tests::suite::{instructions, judge};

fn main() -> ExitCode {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("suite");
    let mut trials = Vec::new();
    collect(&root, "", &mut trials);
    assert!(!trials.is_empty(), "no programs in {}", root.display());
    libtest_mimic::run(&Arguments::from_args(), trials).exit_code()
}

/// Adds a test for every program in `folder` and below it.
fn collect(folder: &Path, prefix: &str, trials: &mut Vec<Trial>) {
    let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    for entry in entries {
        let path = entry.expect("the folder can be read").path();
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() {
            collect(&path, &format!("{prefix}{stem}/"), trials);
        } else if path.extension().is_some_and(|extension| extension == "mist") {
            trials.push(Trial::test(format!("{prefix}{stem}"), move || test(&path)));
        }
    }
}

fn test(path: &Path) -> Result<(), Failed> {
    let text = fs::read_to_string(path)?;
    let outcome = instructions::read(&text).and_then(|program| judge::judge(&program));
    outcome.map_err(|why| format!("{}\n{why}", path.display()).into())
}
