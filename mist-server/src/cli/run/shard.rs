//! `mist run --shard k/n`: a part of the steps, into a journal that a later process continues.

use std::{fmt::Write as _, path::Path};

use mist_engine::{Control, Failure, Job, Options, RunSummary};

use super::RunError;
use crate::shard::{Journal, JournalError, Label, Shard};

/// Runs what is left of the shard, and says what was done.
pub(super) fn run(
    job: &Job,
    (options, program): (&Options, &str),
    shard: Shard,
    out: &Path,
    control: &Control,
) -> Result<(RunSummary, String), RunError> {
    if job.runs_in_order() {
        return Err(RunError::Refused(
            "this program cannot be split: its variables, loops or apertures read integrals or \
             outputs of earlier steps, so its steps must run one after the other; run it without \
             --shard"
                .into(),
        ));
    }
    let write = |error: &dyn std::fmt::Display| RunError::Write(error.to_string());
    let name = &options.job;
    let steps = job.count_steps(control)?;
    let what = format!("{:?} {} {program}", options.mode, options.seed);
    let label = Label::new(job, name, shard, steps, &what);
    let path = out.join(shard.file_name(name));
    let mut journal = Journal::open(&path, &label).map_err(|error| match error {
        JournalError::Foreign(_) => RunError::Refused(error.to_string()),
        _ => write(&error),
    })?;
    let part = shard.steps(steps);
    let before = journal.next - part.start;
    let mut summary = RunSummary::default();
    if !journal.complete {
        summary = job.run_part(journal.next..part.end, &mut journal, control).map_err(failed)?;
        journal.end(summary.seconds).map_err(|error| write(&error))?;
    }
    let mut text = format!(
        "{name}: shard {shard}: {} of {steps} steps, {before} of them done before, {:.3e} evaluations, {:.2} s\n",
        part.end - part.start,
        summary.evaluations,
        summary.seconds,
    );
    let shown = path.strip_prefix(".").unwrap_or(&path);
    // Writing to a string cannot fail.
    let _ = writeln!(text, "  {:<14} {}", "shard", shown.display());
    if job.colour().is_some() {
        text.push_str(
            "  note: shards have no colours; see `mist table --from` for the merged table\n",
        );
    }
    Ok((summary, text))
}

/// A shard keeps what it has.
fn failed(failure: Failure) -> RunError {
    match failure {
        Failure::Cancelled => RunError::Write(
            "the run was cancelled; the same command goes on behind its last finished step".into(),
        ),
        other => RunError::Engine(other),
    }
}
