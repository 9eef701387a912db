//! The materials that the service keeps.

use std::{
    collections::BTreeMap,
    sync::{Arc, PoisonError, RwLock},
};

use axum::{
    Json,
    extract::State,
    http::{StatusCode, header},
    response::{IntoResponse, Response},
};
use mist_engine::material::{Material, MaterialError, PreparedMaterial};
use scattering::Mode;
use serde_json::Value;
use sha2::{Digest, Sha256};

use super::{
    App,
    error::{ApiError, Limit},
    extract::{Path, Text},
    problem::Problems,
    program::ProgramBody,
    schema,
};
use crate::limits::ServeLimits;

/// Bytes of a name.
const LONGEST_NAME: usize = 200;

/// A material that is ready to be evaluated.
#[derive(Debug)]
pub(crate) struct Kept {
    /// The body of the request that brought it.
    pub(crate) text: String,
    /// `sha256-…` of that body.
    pub(crate) hash: String,
    /// The material.
    pub(crate) prepared: PreparedMaterial,
}

impl Kept {
    /// The material that `text` describes: material JSON, a program with files, or the bare text
    /// of a program that needs none.
    pub(super) fn new(text: String, limits: &ServeLimits) -> Result<Self, ApiError> {
        let prepared = prepare(&text, limits)?;
        // Errors of values show when the model is built: now rather than at every table.
        prepared.model()?;
        let hash = format!("sha256-{:x}", Sha256::digest(text.as_bytes()));
        Ok(Self { text, hash, prepared })
    }
}

/// Materials by name.
#[derive(Clone, Debug, Default)]
pub(crate) struct Materials(Arc<RwLock<BTreeMap<String, Arc<Kept>>>>);

impl Materials {
    /// The material called `name`.
    pub(crate) fn find(&self, name: &str) -> Result<Arc<Kept>, ApiError> {
        let all = self.0.read().unwrap_or_else(PoisonError::into_inner);
        all.get(name).cloned().ok_or_else(|| ApiError::NotFound(format!("material {name:?}")))
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.0.read().unwrap_or_else(PoisonError::into_inner).len()
    }

    /// Keeps `kept` under `name`.
    pub(super) fn keep(&self, name: String, kept: Kept) {
        let mut all = self.0.write().unwrap_or_else(PoisonError::into_inner);
        all.insert(name, Arc::new(kept));
    }

    fn forget(&self, name: &str) -> Option<Arc<Kept>> {
        self.0.write().unwrap_or_else(PoisonError::into_inner).remove(name)
    }
}

/// Keep a material: material JSON, a program with its data files, or the text of a program.
#[utoipa::path(
    put,
    path = "/v1/materials/{name}",
    tag = "materials",
    params(schema::Name),
    request_body(content(
        (schema::MaterialBody = "application/json"),
        (String = "text/plain"),
    )),
    responses((status = 201, description = "It is kept", body = schema::Hash), Problems),
)]
pub(super) async fn put(
    State(app): State<App>,
    Path(name): Path<String>,
    Text(body): Text,
) -> Result<(StatusCode, Json<schema::Hash>), ApiError> {
    if name.len() > LONGEST_NAME || name.chars().any(char::is_control) {
        let message = format!("a name has up to {LONGEST_NAME} bytes and no control characters");
        return Err(ApiError::Query(message));
    }
    let most = app.limits.max_materials;
    if app.materials.len() >= most && app.materials.find(&name).is_err() {
        return Err(ApiError::Limit(Limit {
            flag: "max-materials",
            value: most as f64,
            message: format!("{most} materials are kept already: delete one"),
        }));
    }
    let limits = app.limits.clone();
    let kept = app.compute_in_time(move || Kept::new(body, &limits)).await??;
    let hash = kept.hash.clone();
    let (text, key) = (kept.text.clone(), name.clone());
    app.store(move |store| store.put_material(&key, &text)).await?;
    app.materials.keep(name, kept);
    Ok((StatusCode::CREATED, Json(schema::Hash { hash })))
}

fn prepare(body: &str, limits: &ServeLimits) -> Result<PreparedMaterial, ApiError> {
    if !body.trim_start().starts_with('{') {
        return first_step(ProgramBody::bare(body.to_owned()), limits);
    }
    let json: Value = serde_json::from_str(body).map_err(MaterialError::Json)?;
    if json.get("program").is_none() {
        return Ok(Material::from_json(body)?.prepare(Mode::Sound, None)?);
    }
    first_step(serde_json::from_value(json).map_err(MaterialError::Json)?, limits)
}

/// The material of a program's first step.
fn first_step(body: ProgramBody, limits: &ServeLimits) -> Result<PreparedMaterial, ApiError> {
    body.admit(limits)?;
    let job = body.check(limits.engine(limits.max_time))?;
    PreparedMaterial::of_step(&job).map_err(|failure| ApiError::of_program(&body.program, failure))
}

/// The materials that are kept.
#[utoipa::path(
    get,
    path = "/v1/materials",
    tag = "materials",
    responses((status = 200, description = "Names and hashes", body = Vec<schema::Listed>), Problems),
)]
pub(super) async fn list(State(app): State<App>) -> Json<Vec<schema::Listed>> {
    let all = app.materials.0.read().unwrap_or_else(PoisonError::into_inner);
    let each = |(name, kept): (&String, &Arc<Kept>)| schema::Listed {
        name: name.clone(),
        hash: kept.hash.clone(),
    };
    Json(all.iter().map(each).collect())
}

/// What was sent to make the material.
#[utoipa::path(
    get,
    path = "/v1/materials/{name}",
    tag = "materials",
    params(schema::Name),
    responses(
        (status = 200, description = "The body of the request that brought it", content(
            (schema::MaterialBody = "application/json"),
            (String = "text/plain"),
        )),
        Problems,
    ),
)]
pub(super) async fn get(
    State(app): State<App>,
    Path(name): Path<String>,
) -> Result<Response, ApiError> {
    let kept = app.materials.find(&name)?;
    let is_json = kept.text.trim_start().starts_with('{');
    let kind = if is_json { "application/json" } else { "text/plain; charset=utf-8" };
    Ok(([(header::CONTENT_TYPE, kind)], kept.text.clone()).into_response())
}

/// Forget a material.
#[utoipa::path(
    delete,
    path = "/v1/materials/{name}",
    tag = "materials",
    params(schema::Name),
    responses((status = 204, description = "It is forgotten"), Problems),
)]
pub(super) async fn delete(
    State(app): State<App>,
    Path(name): Path<String>,
) -> Result<StatusCode, ApiError> {
    app.materials.find(&name)?;
    let key = name.clone();
    app.store(move |store| store.remove_material(&key)).await?;
    app.materials.forget(&name);
    Ok(StatusCode::NO_CONTENT)
}
