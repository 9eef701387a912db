//! `/metrics`: counters and gauges as Prometheus reads them.

use axum::{extract::State, http::header, response::IntoResponse};

use super::{problem::Problems, state::App};
use crate::metrics;

/// Counters and gauges in the text format of Prometheus.
#[utoipa::path(
    get,
    path = "/metrics",
    tag = "service",
    responses((status = 200, description = "Prometheus text", body = String), Problems),
)]
pub(super) async fn metrics(State(app): State<App>) -> impl IntoResponse {
    let mut text = app.metrics.text();
    for (name, help, value) in [
        ("mist_materials", "Materials kept.", app.materials.len()),
        ("mist_computing", "Answers that are computed.", app.compute.running()),
        ("mist_computing_waiting", "Answers that wait.", app.compute.waiting()),
        ("mist_memory_held_bytes", "Bytes held by requests.", app.memory.reserved()),
        ("mist_tables_kept_bytes", "Bytes of tables kept.", app.files.weight()),
    ] {
        metrics::write_gauge(&mut text, name, help, value);
    }
    metrics::write_jobs(&mut text, &app.jobs.counts());
    ([(header::CONTENT_TYPE, "text/plain; version=0.0.4; charset=utf-8")], text)
}
