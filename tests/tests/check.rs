//! `mist check` on every program of the repository: places of errors, and warnings for valid
//! programs.
//!
//! `UPDATE_GOLDEN=1` rewrites the two lists; a person checks every changed line.

use std::{fmt::Write as _, fs, path::Path};

use mist_engine::Failure;
use mist_format::{Diagnostic, LineIndex};
use mist_tests::corpus::{self, Case, ConformanceProgram};
use scattering::Mode;

/// Programs whose error depends on the file system; the tests of the command line run them.
const ABOUT_THE_DISK: [&str; 2] = ["v_err_files_unwritable", "v_err_missing_program"];

/// Compares `found` with the list `name`, or writes the list.
fn assert_listed(name: &str, found_lines: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("check").join(name);
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(&path, found_lines).unwrap();
    }
    let listed = fs::read_to_string(&path).unwrap_or_default();
    for (found_lines, listed) in found_lines.lines().zip(listed.lines()) {
        assert_eq!(found_lines, listed);
    }
    assert_eq!(found_lines.lines().count(), listed.lines().count());
}

fn wrong_programs() -> Vec<Case> {
    let is_wrong = |case: &Case| {
        matches!(case.kind.as_str(), "error" | "hang")
            && !ABOUT_THE_DISK.contains(&case.name.as_str())
    };
    corpus::cases(&corpus::folder()).into_iter().filter(is_wrong).collect()
}

/// `line:column code`, and the text at this place.
fn place(found: &Diagnostic, text: &str) -> String {
    let at = LineIndex::new(text).location(text, found.span.start);
    let shown = found.span.of(text).lines().next().unwrap_or("");
    format!("{}:{} {} `{shown}`", at.line, at.column, found.code)
}

#[test]
fn every_wrong_program_is_refused_in_its_place() {
    let mut found_lines = String::new();
    let cases = wrong_programs();
    assert_eq!(cases.len() + ABOUT_THE_DISK.len(), 74);
    for case in cases {
        let program = ConformanceProgram::of(&case);
        for mode in [Mode::Compat, Mode::Sound] {
            let found = match program.run(mode) {
                Err(Failure::Program(found)) => found,
                Err(Failure::Step { fault, .. }) => vec![*fault],
                Err(failure) => panic!("{}: {failure}", case.name),
                Ok(_) => Vec::new(),
            };
            let name = case.name.trim_start_matches("v_");
            let mode = if mode == Mode::Compat { "compat" } else { "sound" };
            match found.first() {
                Some(first) => {
                    let place = place(first, &program.text);
                    writeln!(found_lines, "{name} {mode} {place}").unwrap();
                    assert!(first.help.is_some(), "{name} says what to write: {first:?}");
                }
                None => writeln!(found_lines, "{name} {mode} runs").unwrap(),
            }
        }
    }
    assert_listed("refused.txt", &found_lines);
}

#[test]
fn checking_finds_what_running_refuses() {
    for case in wrong_programs() {
        let program = ConformanceProgram::of(&case);
        let refused = program.run(Mode::Compat).is_err();
        let found = program.check(Mode::Compat);
        let error = found.iter().any(Diagnostic::is_error);
        assert_eq!(error, refused, "{}: {found:?}", case.name);
    }
}

#[test]
fn programs_that_run_get_no_warning_but_those_listed() {
    let mut found_lines = String::new();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders = ["conformance/programs", "conformance/bench", "mtab", "../examples"];
    let programs = folders.iter().flat_map(|folder| corpus::programs(&root.join(folder)));
    let mut count = 0;
    for program in
        programs.filter(|p| !p.name.starts_with("v_err") && !p.name.starts_with("v_hang"))
    {
        // The sound dialect refuses some of NIST's programs; compat reads them all.
        let found = program.check(Mode::Compat);
        for found in found {
            assert!(!found.is_error(), "{}: {found:?}", program.name);
            writeln!(found_lines, "{} {}", program.name, place(&found, &program.text)).unwrap();
        }
        count += 1;
    }
    assert!(count > 200, "only {count} programs");
    assert_listed("warned.txt", &found_lines);
}
