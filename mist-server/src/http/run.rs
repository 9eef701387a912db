//! A program that is run while its client waits.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use axum::{
    Json,
    extract::State,
    http::header,
    response::{IntoResponse, Response},
};
use mist_engine::Control;
use mist_runner::results::Results;
use serde::Serialize;
use utoipa::ToSchema;

use super::{
    App,
    error::ApiError,
    extract::Accept,
    problem::{Found, Problems},
    program::ProgramBody,
};
use crate::jobs::MeasuredSink;
use crate::limits::ServeLimits;

/// Run a program with its data files; the answer is its table: text as the program writes it,
/// CSV, or JSON.
///
/// The body is JSON, `multipart/form-data` (a part `program`, every other part a data file; also
/// `compat`, `job`, `seed`), or the bare text of a program.
#[utoipa::path(
    post,
    path = "/v1/run",
    tag = "programs",
    request_body(content(
        (ProgramBody = "application/json"), (String = "text/plain"), (ProgramBody = "multipart/form-data"),
    )),
    responses(
        (status = 200, description = "The table", content(
            (String = "text/plain"), (String = "text/csv"), (serde_json::Value = "application/json"),
        )),
        Problems,
    ),
)]
pub(super) async fn run(
    State(app): State<App>,
    accept: Accept,
    body: ProgramBody,
) -> Result<Response, ApiError> {
    let leash = Leash::default();
    let control = Control { cancel: leash.0.clone(), progress: None };
    let limits = app.limits.clone();
    let (text, header_lines) =
        app.compute_in_time(move || attempt(&body, &limits, &control)).await??;
    Ok(answer(text, header_lines, accept))
}

/// What is wrong with a program, without a run of it; the body is that of `/v1/run`.
#[utoipa::path(
    post,
    path = "/v1/check",
    tag = "programs",
    request_body(content(
        (ProgramBody = "application/json"), (String = "text/plain"), (ProgramBody = "multipart/form-data"),
    )),
    responses((status = 200, description = "Empty if nothing is", body = Checked), Problems),
)]
pub(super) async fn check(
    State(app): State<App>,
    body: ProgramBody,
) -> Result<Json<Checked>, ApiError> {
    let limits = app.limits.clone();
    let work = move || body.check(limits.engine(limits.max_time)).err();
    let problem = app.compute_in_time(work).await?.map(ApiError::problem);
    match problem {
        None => Ok(Json(Checked { diagnostics: Vec::new() })),
        Some(problem) if problem.diagnostics.is_empty() => Err(ApiError::Told(Box::new(problem))),
        Some(problem) => Ok(Json(Checked { diagnostics: problem.diagnostics })),
    }
}

/// What a check found.
#[derive(Serialize, ToSchema)]
pub(super) struct Checked {
    /// Every mistake, in the order of the text.
    diagnostics: Vec<Found>,
}

/// The results, and how many header lines they have.
fn attempt(
    body: &ProgramBody,
    limits: &ServeLimits,
    control: &Control,
) -> Result<(String, usize), ApiError> {
    let job = body.check(limits.engine(limits.max_time))?;
    let mut sink = MeasuredSink::new(limits.max_output);
    job.run(&mut sink, control).map_err(|failure| ApiError::of_program(&body.program, failure))?;
    Ok((sink.results, job.program().files.headers().count()))
}

/// Results in the form that the client likes best.
pub(super) fn answer(text: String, header_lines: usize, accept: Accept) -> Response {
    let typed =
        |kind: &'static str, text: String| ([(header::CONTENT_TYPE, kind)], text).into_response();
    match accept {
        Accept::Text => typed("text/plain; charset=utf-8", text),
        Accept::Csv => typed("text/csv; charset=utf-8", Results::read(&text, header_lines).csv()),
        Accept::Json => Json(Results::read(&text, header_lines).json()).into_response(),
    }
}

/// Stops the work when the answer is not awaited any more, because the client has gone.
#[derive(Default)]
pub(super) struct Leash(pub(super) Arc<AtomicBool>);

impl Drop for Leash {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}
