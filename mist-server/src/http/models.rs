//! The registry of models: what there is, and which parameters it has.

use axum::{
    Json,
    http::header,
    response::{IntoResponse, Response},
};
use mist_runner::registry;
use serde_json::Value;

use super::{error::ApiError, extract::PathParameters, problem::Problems};

/// Every class of model and of what models are made of, by family.
#[utoipa::path(
    get,
    path = "/v1/models",
    operation_id = "list_models",
    tag = "models",
    responses((status = 200, description = "Families with their classes", body = Value), Problems),
)]
pub(super) async fn list() -> Json<Value> {
    Json(registry::list())
}

/// A class: its description, and the JSON Schema of its parameters with units and defaults.
#[utoipa::path(
    get,
    path = "/v1/models/{name}",
    operation_id = "get_model",
    tag = "models",
    params(("name" = String, Path, description = "Name of the class", example = "Facet_BRDF_Model")),
    responses((
        status = 200, description = "JSON Schema (2020-12) of the parameters",
        body = Value, content_type = "application/schema+json",
    ), Problems),
)]
pub(super) async fn get(
    PathParameters(name): PathParameters<String>,
) -> Result<Response, ApiError> {
    let class = scattering::registry::find_class(&name);
    let class = class.ok_or_else(|| ApiError::NotFound(registry::unknown(&name)))?;
    let kind = [(header::CONTENT_TYPE, "application/schema+json")];
    Ok((kind, Json(registry::schema(class))).into_response())
}
