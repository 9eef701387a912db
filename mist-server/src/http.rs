//! The HTTP service: every route on one screen.

mod asked;
mod error;
mod export;
mod materials;
mod table;

use axum::{
    Router,
    extract::DefaultBodyLimit,
    routing::{get, post, put},
};

use crate::compute::Compute;
use materials::Materials;

/// Largest body of a request: a program with its data files.
const MOST_BYTES: usize = 16 << 20;
/// Tables that are computed at the same time; each uses all threads.
const PLACES: usize = 2;

/// What handlers share.
#[derive(Clone)]
pub struct App {
    compute: Compute,
    materials: Materials,
}

impl Default for App {
    fn default() -> Self {
        Self { compute: Compute::new(PLACES), materials: Materials::default() }
    }
}

/// The service, without a socket.
pub fn router(app: App) -> Router {
    let router = Router::new()
        .route("/healthz", get(async || "ok\n"))
        .route("/v1/materials", get(materials::list))
        .route(
            "/v1/materials/{name}",
            put(materials::put).get(materials::get).delete(materials::delete),
        )
        .route("/v1/materials/{name}/integrate", post(table::integrate))
        .route("/v1/materials/{name}/{file}", get(table::table));
    export::routes(router).layer(DefaultBodyLimit::max(MOST_BYTES)).with_state(app)
}
