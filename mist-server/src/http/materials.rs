//! `/v1/materials`: put, list, get and delete materials.

use axum::{
    Json,
    extract::State,
    http::{HeaderMap, StatusCode, Uri, header},
    response::{IntoResponse, Response},
};

use mist_engine::Control;

use super::{
    client::Client,
    error::ApiError,
    extract::{MistText, PathParameters},
    media::MIST,
    preconditions,
    problem::Problems,
    schema,
    state::App,
};
use crate::{compute::WorkSize, limits::LimitReached, materials::StoredMaterial};

/// Bytes of a name.
const LONGEST_NAME: usize = 200;

/// Keep a material: material JSON, a program with its data files, or the text of a program.
#[utoipa::path(
    put,
    path = "/v1/materials/{name}",
    operation_id = "put_material",
    tag = "materials",
    params(schema::MaterialName),
    request_body(content(
        (schema::MaterialBody = "application/json"),
        (String = "application/x-mist"),
    )),
    responses(
        (status = 200, description = "It is kept in the place of another", body = schema::MaterialHash,
            headers(("ETag" = String), ("Location" = String))),
        (status = 201, description = "It is kept", body = schema::MaterialHash,
            headers(("ETag" = String), ("Location" = String))),
        Problems,
    ),
)]
pub(super) async fn put(
    State(app): State<App>,
    PathParameters(name): PathParameters<String>,
    client: Client,
    uri: Uri,
    headers: HeaderMap,
    body: MistText,
) -> Result<Response, ApiError> {
    if name.len() > LONGEST_NAME || name.chars().any(char::is_control) {
        let message = format!("a name has up to {LONGEST_NAME} bytes and no control characters");
        return Err(ApiError::Query(message));
    }
    let most = app.limits.max_materials;
    let known = app.materials.find(&name).ok();
    preconditions::check(&headers, known.as_ref().map(|known| known.hash.as_str()))?;
    if let Some(known) = &known {
        client.may_change(known.owner.as_deref(), "the material")?;
    }
    if app.materials.len() >= most && known.is_none() {
        return Err(ApiError::Limit(LimitReached {
            flag: "max-materials",
            value: most as f64,
            message: format!("{most} materials are kept already: delete one"),
        }));
    }
    let (limits, owner) = (client.limits.clone(), Some(client.name.clone()));
    let work = move |_: &Control| StoredMaterial::new(body.text, body.is_json, owner, &limits);
    let kept = app.compute_in_time(&client, WorkSize::Small, work).await??;
    let hash = kept.hash.clone();
    let (text, key) = (kept.text.clone(), name.clone());
    app.store(move |store| store.put_material(&key, &text, &client.name)).await?;
    app.materials.insert(name, kept);
    let status = if known.is_some() { StatusCode::OK } else { StatusCode::CREATED };
    let tags = [(header::ETAG, format!("\"{hash}\"")), (header::LOCATION, uri.path().to_owned())];
    Ok((status, tags, Json(schema::MaterialHash { hash })).into_response())
}

/// The materials that are kept.
#[utoipa::path(
    get,
    path = "/v1/materials",
    operation_id = "list_materials",
    tag = "materials",
    responses((status = 200, description = "Names and hashes", body = Vec<schema::MaterialEntry>), Problems),
)]
pub(super) async fn list(State(app): State<App>) -> Json<Vec<schema::MaterialEntry>> {
    let all = app.materials.list().into_iter();
    Json(all.map(|(name, hash)| schema::MaterialEntry { name, hash }).collect())
}

/// The body of the request that brought the material.
#[utoipa::path(
    get,
    path = "/v1/materials/{name}",
    operation_id = "get_material",
    tag = "materials",
    params(schema::MaterialName),
    responses(
        (status = 200, description = "The body of the request that brought it",
            headers(("ETag" = String)), content(
            (schema::MaterialBody = "application/json"),
            (String = "application/x-mist"),
        )),
        (status = 304, description = "The client has it", headers(("ETag" = String))),
        Problems,
    ),
)]
pub(super) async fn get(
    State(app): State<App>,
    PathParameters(name): PathParameters<String>,
    headers: HeaderMap,
) -> Result<Response, ApiError> {
    let kept = app.materials.find(&name)?;
    let tag = [(header::ETAG, format!("\"{}\"", kept.hash))];
    if preconditions::is_known(&headers, &tag[0].1) {
        return Ok((StatusCode::NOT_MODIFIED, tag).into_response());
    }
    let kind = if kept.is_json { "application/json" } else { MIST };
    Ok((tag, [(header::CONTENT_TYPE, kind)], kept.text.clone()).into_response())
}

/// Forget a material.
#[utoipa::path(
    delete,
    path = "/v1/materials/{name}",
    operation_id = "delete_material",
    tag = "materials",
    params(schema::MaterialName),
    responses((status = 204, description = "It is forgotten"), Problems),
)]
pub(super) async fn delete(
    State(app): State<App>,
    PathParameters(name): PathParameters<String>,
    client: Client,
    headers: HeaderMap,
) -> Result<StatusCode, ApiError> {
    let kept = app.materials.find(&name)?;
    preconditions::check(&headers, Some(&kept.hash))?;
    client.may_change(kept.owner.as_deref(), "the material")?;
    let key = name.clone();
    app.store(move |store| store.remove_material(&key)).await?;
    app.materials.remove(&name);
    Ok(StatusCode::NO_CONTENT)
}
