//! Liveness and readiness of the service.

use axum::extract::State;

use super::{error::ApiError, problem::Problems, state::App};
use crate::store::Store;

/// Liveness: the process answers.
#[utoipa::path(
    get,
    path = "/healthz",
    tag = "service",
    responses((status = 200, description = "It does", body = String), Problems),
)]
pub(super) async fn healthz() -> &'static str {
    "ok\n"
}

/// Readiness: the service is not stopping, it has threads to compute, and its store can be written.
#[utoipa::path(
    get,
    path = "/readyz",
    tag = "service",
    responses((status = 200, description = "It does", body = String), Problems),
)]
pub(super) async fn readyz(State(app): State<App>) -> Result<&'static str, ApiError> {
    if app.jobs.is_stopping() {
        return Err(ApiError::Unavailable("the service is stopping".into()));
    }
    if !app.compute.accepts_work() {
        return Err(ApiError::Unavailable("the system has no threads for computations".into()));
    }
    app.store(Store::try_writing).await?;
    Ok("ready\n")
}
