//! A program that is run while its client waits.

use axum::{
    Json,
    extract::State,
    http::header,
    response::{IntoResponse, Response},
};
use mist_engine::{Control, request::ProgramDescription};
use mist_runner::results::Results;
use serde::Serialize;
use serde_json::json;
use utoipa::ToSchema;

use super::{
    client::Client, error::ApiError, extract::Accept, problem::Problems, program::ProgramRequest,
    schema::ProgramBody, state::App, warnings::with_diagnostics,
};
use crate::{
    compute::WorkSize,
    failure::{LocatedDiagnostic, located},
    limits::ServeLimits,
    output::BoundedOutput,
    program::{ProgramError, compiled},
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
        (ProgramBody = "application/json"), (String = "application/x-mist"),
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
    ProgramRequest(body): ProgramRequest,
) -> Result<Response, ApiError> {
    let limits = client.limits.clone();
    let work = move |control: &Control| attempt(&body, &limits, control);
    let table = app.compute_in_time(&client, WorkSize::Small, work).await??;
    Ok(answer(table, accept))
}

/// Check a program without running it; the body is that of `/v1/run`.
#[utoipa::path(
    post,
    path = "/v1/check",
    tag = "programs",
    request_body(content(
        (ProgramBody = "application/json"), (String = "application/x-mist"),
    )),
    responses((status = 200, description = "Empty if nothing is", body = Checked), Problems),
)]
pub(super) async fn check(
    State(app): State<App>,
    client: Client,
    ProgramRequest(body): ProgramRequest,
) -> Result<Json<Checked>, ApiError> {
    let limits = client.limits.clone();
    let work = move |_: &Control| {
        let job = compiled(&body, limits.engine(limits.max_time))?;
        Ok::<_, ProgramError>(located(&body.program, &job.slips()))
    };
    let found = app.compute_in_time(&client, WorkSize::Small, work).await?;
    match found.map_err(|error| ApiError::from(error).problem()) {
        Ok(warnings) => Ok(Json(Checked { diagnostics: Vec::new(), warnings })),
        Err(problem) if problem.diagnostics.is_empty() => Err(ApiError::Problem(Box::new(problem))),
        Err(problem) => {
            Ok(Json(Checked { diagnostics: problem.diagnostics, warnings: Vec::new() }))
        }
    }
}

/// The result of a check.
#[derive(Serialize, ToSchema)]
pub(super) struct Checked {
    /// Every mistake, in the order of the text.
    diagnostics: Vec<LocatedDiagnostic>,
    /// Numbers that look like slips of units.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<LocatedDiagnostic>,
}

/// The results of a program.
pub(super) struct ResultsText {
    pub(super) text: String,
    /// Lines before the line of names.
    pub(super) header_lines: usize,
    pub(super) warnings: Vec<LocatedDiagnostic>,
}

/// Runs the program.
fn attempt(
    body: &ProgramDescription,
    limits: &ServeLimits,
    control: &Control,
) -> Result<ResultsText, ProgramError> {
    let job = compiled(body, limits.engine(limits.max_time))?;
    let mut sink = BoundedOutput::new(limits.max_output);
    let mut warnings = job.slips();
    let summary =
        job.run(&mut sink, control).map_err(|failure| ProgramError::of(&body.program, failure))?;
    warnings.extend(summary.warnings);
    Ok(ResultsText {
        text: sink.results,
        header_lines: job.program().files.headers().count(),
        warnings: located(&body.program, &warnings),
    })
}

/// Results in the form that the client likes best.
pub(super) fn answer(table: ResultsText, accept: Accept) -> Response {
    let ResultsText { text, header_lines, warnings } = table;
    let typed =
        |kind: &'static str, text: String| ([(header::CONTENT_TYPE, kind)], text).into_response();
    let response = match accept {
        Accept::Text => typed("text/plain; charset=utf-8", text),
        Accept::Csv => typed("text/csv; charset=utf-8", Results::read(&text, header_lines).csv()),
        Accept::Json => {
            let mut json = Results::read(&text, header_lines).json();
            if !warnings.is_empty() {
                json["warnings"] = json!(warnings);
            }
            Json(json).into_response()
        }
    };
    with_diagnostics(response, &warnings)
}
