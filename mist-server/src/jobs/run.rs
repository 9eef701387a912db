//! Running one job.

use std::{
    io,
    sync::{PoisonError, atomic::Ordering},
};

use axum::http::StatusCode;
use mist_engine::{Control, Failure, OutputStream, RunSummary, Sink, compile};
use rise_bridge::{formats, write::Style};

use super::{Job, MeasuredSink, Office, State, ledger::Ledger};
use crate::http::{ApiError, Problem, ProgramBody};

/// Runs `job` to its end, or until the service stops.
pub(super) fn run(office: &Office, job: &Job) {
    let body = match program(office, job) {
        Ok(body) => body,
        Err(error) => {
            let problem = ApiError::Unavailable(error.to_string()).problem();
            return office.finish(job, State::Failed, |status| status.problem = Some(problem), &[]);
        }
    };
    let work = || attempt(office, job, &body);
    let done = std::panic::catch_unwind(std::panic::AssertUnwindSafe(work));
    let problem = match done {
        Ok(Ok(())) => return,
        Ok(Err(failure)) => {
            let is_cancelled = matches!(failure, Failure::Cancelled);
            if is_cancelled && office.desk().stopping {
                // It stays as it is in the store and goes on when the service starts again.
                job.status.send_modify(|status| status.state = State::Queued);
                return;
            }
            if is_cancelled {
                return office.finish(job, State::Cancelled, |_| (), &[]);
            }
            ApiError::of_program(&body.program, failure).problem()
        }
        Err(_) => {
            let message = "the computation broke down";
            Problem::new(StatusCode::INTERNAL_SERVER_ERROR, "failed", message)
        }
    };
    office.finish(job, State::Failed, |status| status.problem = Some(problem), &[]);
}

/// The program of a job, which only the store has while it waits.
fn program(office: &Office, job: &Job) -> io::Result<ProgramBody> {
    let text = office.store.program(&job.id)?;
    let text = text.ok_or_else(|| io::Error::other("the program of the job is not kept"))?;
    Ok(serde_json::from_str(&text)?)
}

/// The sink of a job: everybody may look into it while it fills.
struct Live<'a>(&'a Job);

impl Sink for Live<'_> {
    fn write(&mut self, stream: OutputStream, text: &str) -> io::Result<()> {
        self.0.live.lock().unwrap_or_else(PoisonError::into_inner).write(stream, text)
    }
}

fn attempt(office: &Office, job: &Job, body: &ProgramBody) -> Result<(), Failure> {
    let limits = &office.limits;
    let options = body.options(limits.engine(limits.max_job_time));
    let compiled = compile(&body.program, body.files(), &options).map_err(Failure::Program)?;
    let header_lines = compiled.program().files.headers().count();
    job.status.send_modify(|status| status.header_lines = header_lines);
    *job.live.lock().unwrap_or_else(PoisonError::into_inner) = MeasuredSink::new(limits.max_output);
    let progress = job.status.clone();
    let control = Control {
        cancel: job.cancel.clone(),
        progress: Some(Box::new(move |part| {
            progress.send_modify(|status| status.progress = part);
        })),
    };
    let mut ledger = Ledger::new(&office.store, &job.id);
    let ran = compiled.run_on(&mut Live(job), &control, &mut ledger);
    let recalled = ledger.recalled;
    let kept = ledger.flush();
    let summary = match ran {
        // A wish to cancel that came too late.
        Ok(_) if job.cancel.load(Ordering::Relaxed) => return Err(Failure::Cancelled),
        other => other?,
    };
    kept?;
    let texts = texts(job, &summary)?;
    let tell = |status: &mut super::Status| {
        status.steps = Some(summary.steps);
        status.resumed_after = (recalled > 0).then_some(recalled);
        status.defects = summary.met.iter().map(ToString::to_string).collect();
        status.texts = texts.iter().map(|(kind, _)| kind.clone()).collect();
    };
    office.finish(job, State::Done, tell, &texts);
    Ok(())
}

/// The texts of a finished run by their names.
fn texts(job: &Job, summary: &RunSummary) -> Result<Vec<(String, String)>, Failure> {
    let live = job.live.lock().unwrap_or_else(PoisonError::into_inner).clone();
    let mut texts =
        vec![("results".to_owned(), live.results), ("listing".to_owned(), live.listing)];
    if !live.samples.is_empty() {
        texts.push(("samples".to_owned(), live.samples));
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
