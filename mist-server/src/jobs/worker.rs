//! Runs one job.

use std::{
    io,
    sync::{PoisonError, atomic::Ordering},
};

use mist_engine::{Control, Failure, OutputStream, RunSummary, Sink, request::ProgramDescription};
use rise_bridge::{formats, write::Style};

use super::{
    job::ServiceJob,
    scheduler::Scheduler,
    status::{JobState, JobStatus},
    step_journal::StepJournal,
};
use crate::{
    compute::{WorkFailure, WorkPool},
    failure::{FailureReport, located},
    output::BoundedOutput,
    program::ProgramError,
};

/// Runs `job` to its end, or until the service stops.
pub(super) fn run(scheduler: &Scheduler, job: &ServiceJob, threads: &WorkPool) {
    let body = match program(scheduler, job) {
        Ok(body) => body,
        Err(error) => {
            let problem = FailureReport::new("unavailable", error.to_string());
            return scheduler.finish(
                job,
                JobState::Failed,
                |status| status.problem = Some(problem),
                &[],
            );
        }
    };
    let done = threads.run(&job.cancel, || attempt(scheduler, job, &body));
    let problem = match done.or_else(as_cancelled) {
        Ok(Ok(())) => return,
        Ok(Err(failure)) => {
            let is_cancelled = matches!(failure, Failure::Cancelled);
            if is_cancelled && scheduler.queue().stopping {
                // It stays as it is in the store and goes on when the service starts again.
                job.status.send_modify(|status| status.state = JobState::Queued);
                return;
            }
            if is_cancelled {
                return scheduler.finish(job, JobState::Cancelled, |_| (), &[]);
            }
            ProgramError::of(&body.program, failure).report()
        }
        Err(WorkFailure::Panicked | WorkFailure::Interrupted) => {
            FailureReport::new("failed", "the computation broke down")
        }
    };
    scheduler.finish(job, JobState::Failed, |status| status.problem = Some(problem), &[]);
}

/// A run that was interrupted is one that was cancelled.
fn as_cancelled(failure: WorkFailure) -> Result<Result<(), Failure>, WorkFailure> {
    match failure {
        WorkFailure::Interrupted => Ok(Err(Failure::Cancelled)),
        WorkFailure::Panicked => Err(failure),
    }
}

/// The program of a job, which only the store has while it waits.
fn program(scheduler: &Scheduler, job: &ServiceJob) -> io::Result<ProgramDescription> {
    let text = scheduler.store.program(&job.id)?;
    let text = text.ok_or_else(|| io::Error::other("the program of the job is not kept"))?;
    Ok(serde_json::from_str(&text)?)
}

/// The sink of a job; clients may read its output while the job runs.
struct LiveOutput<'a>(&'a ServiceJob);

impl Sink for LiveOutput<'_> {
    fn write(&mut self, stream: OutputStream, text: &str) -> io::Result<()> {
        self.0.output.lock().unwrap_or_else(PoisonError::into_inner).write(stream, text)
    }
}

fn attempt(
    scheduler: &Scheduler,
    job: &ServiceJob,
    body: &ProgramDescription,
) -> Result<(), Failure> {
    let limits = &scheduler.limits;
    let options = body.options("job", limits.engine(limits.max_job_time));
    let compiled = body.compile(&options, None).map_err(Failure::Program)?;
    let header_lines = compiled.program().files.headers().count();
    job.status.send_modify(|status| status.header_lines = header_lines);
    *job.output.lock().unwrap_or_else(PoisonError::into_inner) =
        BoundedOutput::new(limits.max_output);
    let progress = job.status.clone();
    let control = Control {
        cancel: job.cancel.clone(),
        progress: Some(Box::new(move |part| {
            progress.send_modify(|status| status.progress = part);
        })),
    };
    let mut journal = StepJournal::new(&scheduler.store, &job.id);
    let ran = compiled.run_on(&mut LiveOutput(job), &control, &mut journal);
    let recalled = journal.recalled;
    let kept = journal.flush();
    let mut summary = match ran {
        // The cancellation came after the last step.
        Ok(_) if job.cancel.load(Ordering::Relaxed) => return Err(Failure::Cancelled),
        other => other?,
    };
    kept?;
    let texts = texts(job, &summary)?;
    let mut warnings = compiled.slips();
    warnings.append(&mut summary.warnings);
    let tell = |status: &mut JobStatus| {
        status.steps = Some(summary.steps);
        status.resumed_after = (recalled > 0).then_some(recalled);
        status.defects = summary.met.iter().map(ToString::to_string).collect();
        status.warnings = located(&body.program, &warnings);
        status.texts = texts.iter().map(|(kind, _)| kind.clone()).collect();
    };
    scheduler.finish(job, JobState::Done, tell, &texts);
    Ok(())
}

/// The texts of a finished run by their names.
fn texts(job: &ServiceJob, summary: &RunSummary) -> Result<Vec<(String, String)>, Failure> {
    let output = job.output.lock().unwrap_or_else(PoisonError::into_inner).clone();
    let mut texts =
        vec![("results".to_owned(), output.results), ("listing".to_owned(), output.listing)];
    if !output.samples.is_empty() {
        texts.push(("samples".to_owned(), output.samples));
    }
    let Some(table) = &summary.colour else { return Ok(texts) };
    for (format, writer) in formats::of_colours() {
        let kind = format!("table.{}", format.extension);
        let text = (writer.text)(table, 0, Style::default());
        let text = text.map_err(|error| Failure::Write(io::Error::other(error.to_string())))?;
        texts.push((kind, text));
    }
    Ok(texts)
}
