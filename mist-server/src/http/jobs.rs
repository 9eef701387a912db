//! Programs that run in the background.

use std::{convert::Infallible, sync::Arc};

use axum::{
    Json,
    extract::State,
    http::{HeaderValue, StatusCode, header},
    response::{
        IntoResponse, Response, Sse,
        sse::{Event, KeepAlive},
    },
};
use futures_util::{Stream, StreamExt, stream};
use rise_bridge::formats::{self, FileFormat};
use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};

use super::job_document::JobDocument;
use super::{
    client::Client,
    error::ApiError,
    extract::{Accept, PathParameters, Query},
    problem::Problems,
    program::ProgramRequest,
    run::{ResultsText, answer},
    schema::ProgramBody,
    state::App,
};
use crate::{
    compute::WorkSize,
    jobs::{JobState, JobStatus, ServiceJob},
    program::{ProgramError, compiled},
};

/// An accepted job.
#[derive(Serialize, ToSchema)]
pub(super) struct Accepted {
    /// Its name in addresses.
    id: String,
}

/// A job.
#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[expect(dead_code, reason = "describes the API")]
pub(super) struct JobId {
    /// The id of the job.
    id: String,
}

/// Options of results.
#[derive(Default, Deserialize, IntoParams)]
#[serde(deny_unknown_fields, default)]
#[into_params(parameter_in = Query)]
pub(super) struct ResultsOptions {
    /// Give the rows of a running job as far as they are.
    partial: bool,
}

/// Options of a colour table.
#[derive(Default, Deserialize, IntoParams)]
#[serde(deny_unknown_fields, default)]
#[into_params(parameter_in = Query)]
pub(super) struct TableOptions {
    /// `mtab`, `mspd`, `json` or `svg`.
    format: Option<String>,
}

/// Run a program in the background; the body is that of `/v1/run`.
#[utoipa::path(
    post,
    path = "/v1/jobs",
    operation_id = "submit_job",
    tag = "jobs",
    request_body(content(
        (ProgramBody = "application/json"), (String = "application/x-mist"),
    )),
    responses(
        (status = 202, description = "It is kept and will run", body = Accepted,
            headers(("Location" = String))),
        Problems,
    ),
)]
pub(super) async fn submit(
    State(app): State<App>,
    client: Client,
    ProgramRequest(body): ProgramRequest,
) -> Result<Response, ApiError> {
    app.jobs.admit(&client.name)?;
    // An invalid program is refused now, not when the job runs.
    let limits = app.limits.clone();
    let body = app
        .compute_in_time(&client, WorkSize::Small, move |_| {
            compiled(&body, limits.engine(limits.max_job_time))?;
            Ok::<_, ProgramError>(body)
        })
        .await??;
    let status = app.blocking(move |app| Ok(app.jobs.submit(&body, client.name)?)).await?;
    let location = HeaderValue::from_str(&format!("/v1/jobs/{}", status.id));
    let location = location.map_err(|error| ApiError::Failed(error.to_string()))?;
    let accepted = Json(Accepted { id: status.id });
    Ok((StatusCode::ACCEPTED, [(header::LOCATION, location)], accepted).into_response())
}

/// Every job that is kept, the oldest first.
#[utoipa::path(
    get,
    path = "/v1/jobs",
    operation_id = "list_jobs",
    tag = "jobs",
    responses((status = 200, description = "Where they stand", body = Vec<JobDocument>), Problems),
)]
pub(super) async fn list(State(app): State<App>) -> Json<Vec<JobDocument>> {
    Json(app.jobs.list().into_iter().map(JobDocument::from).collect())
}

/// The status of a job.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}",
    operation_id = "get_job",
    tag = "jobs",
    params(JobId),
    responses((status = 200, description = "Where it stands", body = JobDocument), Problems),
)]
pub(super) async fn get(
    State(app): State<App>,
    PathParameters(id): PathParameters<String>,
) -> Result<Json<JobDocument>, ApiError> {
    Ok(Json(app.jobs.find(&id)?.status().into()))
}

/// Cancel a job that waits or runs; forget one that is over.
#[utoipa::path(
    delete,
    path = "/v1/jobs/{id}",
    operation_id = "delete_job",
    tag = "jobs",
    params(JobId),
    responses(
        (status = 200, description = "It was over and is forgotten, or it is cancelled", body = JobDocument),
        (status = 202, description = "It will stop soon", body = JobDocument),
        Problems,
    ),
)]
pub(super) async fn cancel(
    State(app): State<App>,
    PathParameters(id): PathParameters<String>,
    client: Client,
) -> Result<(StatusCode, Json<JobDocument>), ApiError> {
    let job = app.jobs.find(&id)?;
    client.may_change(Some(job.client()), "the job")?;
    let status = app.blocking(move |app| Ok(app.jobs.cancel(&job)?)).await?;
    let code = if status.state.is_over() { StatusCode::OK } else { StatusCode::ACCEPTED };
    Ok((code, Json(status.into())))
}

/// The status of a job, and every change until it is over or the service stops, as server-sent
/// events `status`.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/events",
    operation_id = "job_events",
    tag = "jobs",
    params(JobId),
    responses(
        (status = 200, description = "Events", body = String, content_type = "text/event-stream"),
        Problems,
    ),
)]
pub(super) async fn events(
    State(app): State<App>,
    PathParameters(id): PathParameters<String>,
) -> Result<Sse<impl Stream<Item = Result<Event, Infallible>>>, ApiError> {
    let mut changes = app.jobs.find(&id)?.watch();
    // The first event tells where the job stands now.
    changes.mark_changed();
    let stream = stream::unfold(Some(changes), async |changes| {
        let mut changes = changes?;
        changes.changed().await.ok()?;
        let status = changes.borrow_and_update().clone();
        let rest = (!status.state.is_over()).then_some(changes);
        let document = JobDocument::from(status);
        let event = Event::default().event("status").json_data(&document).unwrap_or_default();
        Some((Ok(event), rest))
    });
    let stream = stream.take_until(app.jobs.left());
    Ok(Sse::new(stream).keep_alive(KeepAlive::default()))
}

/// The results of a finished job: text as the program writes it, CSV, or JSON.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/results",
    operation_id = "job_results",
    tag = "jobs",
    params(JobId, ResultsOptions),
    responses(
        (status = 200, description = "The table", content(
            (String = "text/plain"), (String = "text/csv"), (serde_json::Value = "application/json"),
        )),
        Problems,
    ),
)]
pub(super) async fn results(
    State(app): State<App>,
    PathParameters(id): PathParameters<String>,
    Query(options): Query<ResultsOptions>,
    accept: Accept,
) -> Result<Response, ApiError> {
    let job = app.jobs.find(&id)?;
    let status = job.status();
    let text = if options.partial && status.state == JobState::Running {
        job.results_so_far()
    } else {
        text(&app, job, "results").await?
    };
    let JobStatus { header_lines, warnings, .. } = status;
    Ok(answer(ResultsText { text, header_lines, warnings }, accept))
}

/// The listing of a finished job.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/listing",
    operation_id = "job_listing",
    tag = "jobs",
    params(JobId),
    responses((status = 200, description = "The listing", body = String), Problems),
)]
pub(super) async fn listing(
    State(app): State<App>,
    PathParameters(id): PathParameters<String>,
) -> Result<String, ApiError> {
    text(&app, app.jobs.find(&id)?, "listing").await
}

/// The samples of a finished job, if its program asks for them.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/samples",
    operation_id = "job_samples",
    tag = "jobs",
    params(JobId),
    responses((status = 200, description = "The samples", body = String), Problems),
)]
pub(super) async fn samples(
    State(app): State<App>,
    PathParameters(id): PathParameters<String>,
) -> Result<String, ApiError> {
    text(&app, app.jobs.find(&id)?, "samples").await
}

/// The colour table of a finished job, if its program has a section COLOR.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/table",
    operation_id = "job_table",
    tag = "jobs",
    params(JobId, TableOptions),
    responses(
        (status = 200, description = "The table", content(
            (String = "text/plain"), (serde_json::Value = "application/json"), (String = "image/svg+xml"),
        )),
        Problems,
    ),
)]
pub(super) async fn table(
    State(app): State<App>,
    PathParameters(id): PathParameters<String>,
    Query(options): Query<TableOptions>,
) -> Result<Response, ApiError> {
    let name = options.format.as_deref().unwrap_or(formats::MTAB.name);
    let format = FileFormat::named(name).filter(|format| format.colours().is_some());
    let format = format.ok_or_else(|| {
        let known: Vec<&str> = formats::of_colours().map(|(format, _)| format.name).collect();
        ApiError::Query(format!("format: {name:?} is none of {}", known.join(", ")))
    })?;
    let kind = format!("table.{}", format.extension);
    let text = text(&app, app.jobs.find(&id)?, kind).await?;
    Ok(([(header::CONTENT_TYPE, format.media_type)], text).into_response())
}

/// A text of a job that is done.
async fn text(
    app: &App,
    job: Arc<ServiceJob>,
    kind: impl Into<String>,
) -> Result<String, ApiError> {
    let status = job.status();
    match status.state {
        JobState::Done => {}
        JobState::Failed => {
            let why = status.problem.map_or_else(String::new, |problem| problem.message);
            return Err(ApiError::Conflict(format!("the job failed: {why}")));
        }
        other => return Err(ApiError::Conflict(format!("the job is {}", other.name()))),
    }
    let kind = kind.into();
    let wanted = kind.clone();
    let found = app.blocking(move |app| Ok(app.jobs.text(&job, &wanted)?)).await?;
    found.ok_or_else(|| ApiError::NotFound(format!("{kind} of this job")))
}
