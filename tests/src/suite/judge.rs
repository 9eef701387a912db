//! Runs a program of the suite and compares the outcome with its expectations.

use std::{collections::BTreeSet, sync::Arc};

use mist_engine::{Control, Failure, Job, MemoryFiles, MemorySink, Options, compile};
use mist_format::Diagnostic;
use scattering::Mode;

use super::instructions::{Expectation, ExpectedDiagnostic, ExpectedOutcome, SuiteProgram};
use crate::compare::{Tolerance, tables};

/// Runs `program` in every mode that it names.
///
/// # Errors
///
/// Every difference, each on a line of its own with mode and line of the expectation.
pub fn judge(program: &SuiteProgram) -> Result<(), String> {
    let mut faults = Vec::new();
    for mode in [Mode::Sound, Mode::Compat] {
        let here: Vec<&Expectation> =
            program.expectations.iter().filter(|e| e.modes.contains(&mode)).collect();
        if !here.is_empty() {
            let found = run(program, mode);
            faults.extend(differences(program, &found, &here).into_iter().map(|why| {
                format!("{}: {why}", if mode == Mode::Sound { "sound" } else { "compat" })
            }));
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(faults.join("\n")) }
}

/// The outcome of a run.
struct FoundOutcome {
    /// The table, or the diagnostics of the refusal.
    results: Result<String, Vec<Diagnostic>>,
    warnings: Vec<Diagnostic>,
    /// Names of the defects that a sound run met.
    met: BTreeSet<String>,
}

fn run(program: &SuiteProgram, mode: Mode) -> FoundOutcome {
    let options = Options { mode, ..Options::default() };
    let files = Arc::new(MemoryFiles(program.files.clone()));
    let mut found =
        FoundOutcome { results: Ok(String::new()), warnings: Vec::new(), met: BTreeSet::new() };
    match compile(&program.text, files, &options) {
        Err(diagnostics) => found.results = Err(diagnostics),
        Ok(job) => run_job(&job, &mut found),
    }
    found
}

fn run_job(job: &Job, found: &mut FoundOutcome) {
    found.warnings = job.advice().into_iter().filter(|warning| !warning.is_error()).collect();
    let mut sink = MemorySink::default();
    found.results = match job.run(&mut sink, &Control::default()) {
        Ok(summary) => {
            found.met = summary.met.iter().map(|notice| format!("{notice:?}")).collect();
            Ok(sink.results)
        }
        Err(Failure::Program(diagnostics)) => Err(diagnostics),
        Err(Failure::Step { fault, .. }) => Err(vec![*fault]),
        Err(other) => {
            let nowhere = mist_format::Span::new(0, 0);
            Err(vec![Diagnostic::error("run/failed", nowhere, other.to_string())])
        }
    };
}

fn differences(
    program: &SuiteProgram,
    found: &FoundOutcome,
    expected: &[&Expectation],
) -> Vec<String> {
    let mut faults = Vec::new();
    let mut warnings: Vec<&Diagnostic> = found.warnings.iter().collect();
    let mut met = found.met.clone();
    let mut has_outcome = false;
    for expectation in expected {
        let fault = match &expectation.outcome {
            ExpectedOutcome::Results { table, relative, of_row } => {
                has_outcome = true;
                results(found, table, *relative, *of_row)
            }
            ExpectedOutcome::Refused(expected) => {
                has_outcome = true;
                refusal(program, found, expected)
            }
            ExpectedOutcome::Warns(expected) => take_warning(program, &mut warnings, expected),
            ExpectedOutcome::Meets(name) => {
                let is_met = met.iter().find(|notice| notice.contains(name.as_str())).cloned();
                is_met
                    .map(|notice| met.remove(&notice))
                    .map(drop)
                    .ok_or_else(|| format!("{name} is not met, only {:?}", found.met))
            }
        };
        faults.extend(fault.err().map(|why| format!("line {}: {why}", expectation.line)));
    }
    if !has_outcome && let Err(diagnostics) = &found.results {
        faults.push(format!("refused: {}", shown(program, diagnostics)));
    }
    faults.extend(warnings.iter().map(|w| format!("unexpected {}", one(program, w))));
    faults.extend(met.iter().map(|name| format!("meets {name}, which no line expects")));
    faults
}

fn results(found: &FoundOutcome, table: &str, relative: f64, of_row: f64) -> Result<(), String> {
    let got = found.results.as_ref().map_err(|diagnostics| {
        format!("refused: {}", diagnostics.iter().map(ToString::to_string).collect::<String>())
    })?;
    let got = words(got);
    let tolerance = Tolerance { relative, of_row, header_lines: 1, loop_columns: 0 };
    tables(&got, &words(table), tolerance).map_err(|why| {
        format!("{why}; the run gives\n;| {}", got.trim_end().replace('\n', "\n;| "))
    })
}

/// The words of every line that is not blank, with tabs between them.
fn words(text: &str) -> String {
    let lines = text.lines().filter(|line| !line.trim().is_empty());
    lines.map(|line| line.split_whitespace().collect::<Vec<_>>().join("\t") + "\n").collect()
}

fn refusal(
    program: &SuiteProgram,
    found: &FoundOutcome,
    expected: &ExpectedDiagnostic,
) -> Result<(), String> {
    match &found.results {
        Ok(table) => Err(format!("not refused; the run gives\n{table}")),
        Err(diagnostics) if diagnostics.iter().any(|d| agrees(program, d, expected)) => Ok(()),
        Err(diagnostics) => Err(format!("refused otherwise: {}", shown(program, diagnostics))),
    }
}

fn take_warning(
    program: &SuiteProgram,
    warnings: &mut Vec<&Diagnostic>,
    expected: &ExpectedDiagnostic,
) -> Result<(), String> {
    match warnings.iter().position(|warning| agrees(program, warning, expected)) {
        Some(at) => {
            warnings.remove(at);
            Ok(())
        }
        None => Err(format!("no such warning: {}", expected.code)),
    }
}

fn agrees(program: &SuiteProgram, found: &Diagnostic, expected: &ExpectedDiagnostic) -> bool {
    let place = found.span.of(&program.text).trim();
    let whole = format!("{found} {} {:?}", found.help.as_deref().unwrap_or(""), found.notes);
    found.code == expected.code
        && expected.place.as_ref().is_none_or(|text| text == place)
        && expected.contains.iter().all(|part| whole.contains(part.as_str()))
}

fn shown(program: &SuiteProgram, diagnostics: &[Diagnostic]) -> String {
    diagnostics.iter().map(|found| format!("\n  {}", one(program, found))).collect()
}

/// A diagnostic as an instruction would expect it, then its message.
fn one(program: &SuiteProgram, found: &Diagnostic) -> String {
    let place = found.span.of(&program.text).lines().next().unwrap_or("");
    format!("{} at `{place}`: {}", found.code, found.message)
}
