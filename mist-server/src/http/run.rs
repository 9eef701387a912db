//! A program that is run while its client waits.

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

use super::{client::Client, error::ApiError, extract::Accept, problem::Problems, state::App};
use crate::{
    compute::WorkSize,
    failure::LocatedDiagnostic,
    limits::ServeLimits,
    output::BoundedOutput,
    program::{ProgramError, ProgramRequest},
};

/// Run a program with its data files; the answer is its table: text as the program writes it,
/// CSV, or JSON.
///
/// The body is JSON, or the bare text of a program as `application/x-mist`.
#[utoipa::path(
    post,
    path = "/v1/run",
    tag = "programs",
    request_body(content(
        (ProgramRequest = "application/json"), (String = "application/x-mist"),
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
    client: Client,
    body: ProgramRequest,
) -> Result<Response, ApiError> {
    let limits = client.limits.clone();
    let work = move |control: &Control| attempt(&body, &limits, control);
    let (text, header_lines) = app.compute_in_time(&client, WorkSize::Small, work).await??;
    Ok(answer(text, header_lines, accept))
}

/// Check a program without running it; the body is that of `/v1/run`.
#[utoipa::path(
    post,
    path = "/v1/check",
    tag = "programs",
    request_body(content(
        (ProgramRequest = "application/json"), (String = "application/x-mist"),
    )),
    responses((status = 200, description = "Empty if nothing is", body = Checked), Problems),
)]
pub(super) async fn check(
    State(app): State<App>,
    client: Client,
    body: ProgramRequest,
) -> Result<Json<Checked>, ApiError> {
    let limits = client.limits.clone();
    let work = move |_: &Control| body.compile(limits.engine(limits.max_time)).err();
    let problem = app
        .compute_in_time(&client, WorkSize::Small, work)
        .await?
        .map(|error| ApiError::from(error).problem());
    match problem {
        None => Ok(Json(Checked { diagnostics: Vec::new() })),
        Some(problem) if problem.diagnostics.is_empty() => {
            Err(ApiError::Problem(Box::new(problem)))
        }
        Some(problem) => Ok(Json(Checked { diagnostics: problem.diagnostics })),
    }
}

/// The result of a check.
#[derive(Serialize, ToSchema)]
pub(super) struct Checked {
    /// Every mistake, in the order of the text.
    diagnostics: Vec<LocatedDiagnostic>,
}

/// The results, and how many header lines they have.
fn attempt(
    body: &ProgramRequest,
    limits: &ServeLimits,
    control: &Control,
) -> Result<(String, usize), ProgramError> {
    let job = body.compile(limits.engine(limits.max_time))?;
    let mut sink = BoundedOutput::new(limits.max_output);
    job.run(&mut sink, control).map_err(|failure| ProgramError::of(&body.program, failure))?;
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
