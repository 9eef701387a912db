//! `/v1/materials`: put, list, get and delete materials.

use axum::{
    Json,
    extract::State,
    http::{StatusCode, header},
    response::{IntoResponse, Response},
};

use mist_engine::Control;

use super::{
    client::Client,
    error::ApiError,
    extract::{MistText, PathParameters},
    media::MIST,
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
    tag = "materials",
    params(schema::MaterialName),
    request_body(content(
        (schema::MaterialBody = "application/json"),
        (String = "application/x-mist"),
    )),
    responses((status = 201, description = "It is kept", body = schema::MaterialHash), Problems),
)]
pub(super) async fn put(
    State(app): State<App>,
    PathParameters(name): PathParameters<String>,
    client: Client,
    body: MistText,
) -> Result<(StatusCode, Json<schema::MaterialHash>), ApiError> {
    if name.len() > LONGEST_NAME || name.chars().any(char::is_control) {
        let message = format!("a name has up to {LONGEST_NAME} bytes and no control characters");
        return Err(ApiError::Query(message));
    }
    let most = app.limits.max_materials;
    let known = app.materials.find(&name).ok();
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
    Ok((StatusCode::CREATED, Json(schema::MaterialHash { hash })))
}

/// The materials that are kept.
#[utoipa::path(
    get,
    path = "/v1/materials",
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
    tag = "materials",
    params(schema::MaterialName),
    responses(
        (status = 200, description = "The body of the request that brought it", content(
            (schema::MaterialBody = "application/json"),
            (String = "application/x-mist"),
        )),
        Problems,
    ),
)]
pub(super) async fn get(
    State(app): State<App>,
    PathParameters(name): PathParameters<String>,
) -> Result<Response, ApiError> {
    let kept = app.materials.find(&name)?;
    let kind = if kept.is_json { "application/json" } else { MIST };
    Ok(([(header::CONTENT_TYPE, kind)], kept.text.clone()).into_response())
}

/// Forget a material.
#[utoipa::path(
    delete,
    path = "/v1/materials/{name}",
    tag = "materials",
    params(schema::MaterialName),
    responses((status = 204, description = "It is forgotten"), Problems),
)]
pub(super) async fn delete(
    State(app): State<App>,
    PathParameters(name): PathParameters<String>,
    client: Client,
) -> Result<StatusCode, ApiError> {
    let kept = app.materials.find(&name)?;
    client.may_change(kept.owner.as_deref(), "the material")?;
    let key = name.clone();
    app.store(move |store| store.remove_material(&key)).await?;
    app.materials.remove(&name);
    Ok(StatusCode::NO_CONTENT)
}
