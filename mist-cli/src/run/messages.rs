//! Messages of finished, failed and interrupted runs.

use std::{collections::BTreeSet, fmt::Write as _, path::Path};

use mist_engine::{Job, RunSummary, Warning};
use mist_runner::{files::WrittenFile, run::ShardRun, shard::Shard};
use scattering::{Defect, Notice};

use super::super::{error::ExitStatus, reporter::Reporter};

/// The message of a finished run.
pub(super) fn describe(job: &str, summary: &RunSummary, files: &[WrittenFile]) -> String {
    let mut text = format!(
        "{job}: {} step{}, {:.3e} evaluations, {:.2} s\n",
        summary.steps,
        if summary.steps == 1 { "" } else { "s" },
        summary.evaluations,
        summary.seconds,
    );
    for file in files {
        text.push_str(file_line(file.title, &file.path).trim_end());
        text.push_str(if file.replaces { " (replaces an older file)\n" } else { "\n" });
    }
    text
}

/// The line about a file that was written.
pub(super) fn file_line(title: &str, path: &Path) -> String {
    format!("  {title:<17} {}\n", shown(path).display())
}

/// The message of a finished shard.
pub(super) fn describe_shard(name: &str, shard: Shard, run: &ShardRun, job: &Job) -> String {
    let ShardRun { summary, steps, steps_before, job_steps, .. } = run;
    let mut text = format!(
        "{name}: shard {shard}: {steps} of {job_steps} steps, {steps_before} of them done before, {:.3e} evaluations, {:.2} s\n",
        summary.evaluations, summary.seconds,
    );
    // Writing to a string cannot fail.
    let _ = writeln!(text, "  {:<17} {}", "shard", shown(&run.path).display());
    if job.colour().is_some() {
        text.push_str(
            "  note: shards have no colours; see `mist table --from` for the merged table\n",
        );
    }
    text
}

/// A path without the working folder before it.
fn shown(path: &Path) -> &Path {
    path.strip_prefix(".").unwrap_or(path)
}

/// Warns of the limits of models that the run passed, and gives the defects that it avoided.
pub(super) fn notices(file: &str, summary: &RunSummary, reporter: &Reporter) -> Vec<Defect> {
    let mut defects = Vec::new();
    for notice in &summary.met {
        match (Warning::of_notice(notice), notice) {
            (Some(warning), _) => reporter.warn(file, &[warning]),
            (None, Notice::Defect(defect)) => defects.push(*defect),
            (None, Notice::Limit(_)) => {}
        }
    }
    defects
}

/// One line about the defects that all runs avoided.
pub(super) fn defects(met: &BTreeSet<Defect>) -> Option<String> {
    let names: Vec<String> = met.iter().map(|defect| format!("[{defect}]")).collect();
    let what = match names.len() {
        0 => return None,
        1 => "a defect of NIST's program is corrected here".to_owned(),
        many => format!("{many} defects of NIST's program are corrected here"),
    };
    Some(format!("note: {what} and --compat reproduces NIST's values: {}", names.join(", ")))
}

/// The message of an interrupted run: what was kept, and how to go on.
pub(super) fn interrupted(program: &Path, shard: Option<(Shard, &Path)>) -> String {
    let program = program.display();
    match shard {
        Some((shard, path)) => format!(
            "interrupted: {program}: finished steps are kept in {}; the same command with --shard \
             {shard} goes on behind them",
            shown(path).display()
        ),
        None => format!(
            "interrupted: {program}: nothing of it was written. Steps that are to survive an \
             interruption are kept by `mist run --shard 1/1 {program}`, which goes on behind them when \
             it is called again; `mist merge` makes its table"
        ),
    }
}

/// One line for many programs.
pub(super) fn total(statuses: &[ExitStatus], programs: usize) -> String {
    let count = |status| statuses.iter().filter(|each| **each == status).count();
    let not_started = programs - statuses.len() + count(ExitStatus::Interrupted);
    format!(
        "{programs} programs: {} good, {} failed, {} refused, {not_started} not run\n",
        count(ExitStatus::Success),
        count(ExitStatus::Failed),
        count(ExitStatus::Refused),
    )
}
