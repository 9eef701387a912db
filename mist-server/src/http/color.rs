//! Colours of spectra.

use axum::{Json, extract::State};
use mist_engine::Control;
use serde_json::Value;

use super::{
    client::Client,
    error::ApiError,
    extract::JsonText,
    problem::{Problem, Problems},
    state::App,
};
use crate::compute::WorkSize;

/// XYZ, Lab and RGB of spectra, as `mist color` gives them.
#[utoipa::path(
    post,
    path = "/v1/color",
    tag = "color",
    request_body(content = Value, description = "One case, or {\"illuminants\": …, \"cases\": […]}",
        example = json!({"wavelengths": [400, 500, 600, 700], "values": [0.1, 0.2, 0.7, 0.8], "illuminant": "D65"})),
    responses((status = 200, description = "One result per case", body = Value), Problems),
)]
pub(super) async fn color(
    State(app): State<App>,
    client: Client,
    JsonText(body): JsonText,
) -> Result<Json<Value>, ApiError> {
    let work = move |_: &Control| -> Result<Value, ApiError> {
        let request = serde_json::from_str(&body)
            .map_err(|error| ApiError::Body(format!("the body is not JSON: {error}")))?;
        let response = spectra::case::evaluate(&request).map_err(|error| {
            let status = axum::http::StatusCode::UNPROCESSABLE_ENTITY;
            ApiError::Problem(Box::new(Problem::new(status, "color", error.to_string())))
        })?;
        serde_json::to_value(response).map_err(|error| ApiError::Failed(error.to_string()))
    };
    app.compute_in_time(&client, WorkSize::Small, work).await?.map(Json)
}
