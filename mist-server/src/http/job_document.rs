//! The JSON of a job.

use axum::http::StatusCode;
use serde::Serialize;
use utoipa::ToSchema;

use super::problem::Problem;
use crate::{
    failure::{FailureReport, LocatedDiagnostic},
    jobs::{JobState, JobStatus},
};

/// Status of a job; times are seconds since 1970.
#[derive(Serialize, ToSchema)]
#[schema(as = Status)]
pub(super) struct JobDocument {
    /// Name in addresses.
    id: String,
    /// Its state.
    state: JobState,
    /// The part that is done, 0 to 1.
    progress: f64,
    /// The name that was given to it.
    #[serde(skip_serializing_if = "Option::is_none")]
    job: Option<String>,
    /// Time of its arrival.
    submitted: f64,
    /// Time of its last start.
    #[serde(skip_serializing_if = "Option::is_none")]
    started: Option<f64>,
    /// Time of its end.
    #[serde(skip_serializing_if = "Option::is_none")]
    finished: Option<f64>,
    /// Lines before the line of names in its results.
    header_lines: usize,
    /// Steps of its loops, once it is done.
    #[serde(skip_serializing_if = "Option::is_none")]
    steps: Option<u64>,
    /// Steps that an earlier run of the service had finished already.
    #[serde(skip_serializing_if = "Option::is_none")]
    resumed_after: Option<u64>,
    /// The reason why it failed.
    #[serde(skip_serializing_if = "Option::is_none")]
    problem: Option<Problem>,
    /// Defects of NIST's library that a sound run stepped around.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    defects: Vec<String>,
    /// Warnings of results that are probably not what was meant.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<LocatedDiagnostic>,
    /// The texts of a job that is done: `results`, `listing`, `samples`, `table.…`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    texts: Vec<String>,
}

impl From<JobStatus> for JobDocument {
    fn from(status: JobStatus) -> Self {
        Self {
            id: status.id,
            state: status.state,
            progress: status.progress,
            job: status.job,
            submitted: status.submitted,
            started: status.started,
            finished: status.finished,
            header_lines: status.header_lines,
            steps: status.steps,
            resumed_after: status.resumed_after,
            problem: status.problem.map(problem),
            defects: status.defects,
            warnings: status.warnings,
            texts: status.texts,
        }
    }
}

/// The failure of a job with the status that its program would have got while its client waited.
fn problem(report: FailureReport) -> Problem {
    let status = match report.code.as_str() {
        "failed" => StatusCode::INTERNAL_SERVER_ERROR,
        "unavailable" => StatusCode::SERVICE_UNAVAILABLE,
        _ => StatusCode::UNPROCESSABLE_ENTITY,
    };
    Problem::of(status, report)
}
