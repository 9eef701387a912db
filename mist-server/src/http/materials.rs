//! The materials that the service keeps.

use std::{
    collections::BTreeMap,
    sync::{Arc, RwLock},
};

use axum::{
    Json,
    extract::{Path, State},
    http::StatusCode,
};
use mist_engine::{
    MemoryFiles, Options, compile,
    material::{Material, MaterialError, Prepared},
};
use scattering::Mode;
use serde::Deserialize;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::{App, error::ApiError};

/// A material that is ready to be evaluated.
#[derive(Debug)]
pub(crate) struct Kept {
    /// The body of the request that brought it.
    pub(crate) text: String,
    /// `sha256-…` of that body.
    pub(crate) hash: String,
    /// The material.
    pub(crate) prepared: Prepared,
}

/// Materials by name.
#[derive(Clone, Debug, Default)]
pub(crate) struct Materials(Arc<RwLock<BTreeMap<String, Arc<Kept>>>>);

impl Materials {
    /// The material called `name`.
    pub(crate) fn find(&self, name: &str) -> Result<Arc<Kept>, ApiError> {
        let all = self.0.read().expect("nobody panics with the lock");
        all.get(name).cloned().ok_or_else(|| ApiError::NotFound(format!("material {name}")))
    }
}

/// A program with its data files, in the place of a material.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Program {
    program: String,
    #[serde(default)]
    files: BTreeMap<String, String>,
    #[serde(default)]
    compat: bool,
}

/// `PUT /v1/materials/{name}`
pub(super) async fn put(
    State(app): State<App>,
    Path(name): Path<String>,
    body: String,
) -> Result<(StatusCode, Json<Value>), ApiError> {
    let text = body.clone();
    let prepared = app.compute.run(move || prepare(&text)).await??;
    let hash = format!("sha256-{:x}", Sha256::digest(body.as_bytes()));
    let kept = Kept { text: body, hash: hash.clone(), prepared };
    app.materials.0.write().expect("nobody panics with the lock").insert(name, Arc::new(kept));
    Ok((StatusCode::CREATED, Json(json!({ "hash": hash }))))
}

/// The material that `body` describes: material JSON, a program with files, or the bare text of
/// a program that needs none.
fn prepare(body: &str) -> Result<Prepared, ApiError> {
    if !body.trim_start().starts_with('{') {
        let program = body.to_owned();
        return first_step(Program { program, files: BTreeMap::new(), compat: false });
    }
    let json: Value = serde_json::from_str(body).map_err(MaterialError::Json)?;
    if json.get("program").is_none() {
        return checked(Material::from_json(body)?.prepare(Mode::Sound, None)?);
    }
    first_step(serde_json::from_value(json).map_err(MaterialError::Json)?)
}

/// The material of a program's first step.
fn first_step(Program { program, files, compat }: Program) -> Result<Prepared, ApiError> {
    let files = files.into_iter().map(|(name, text)| (name, text.into())).collect();
    let mode = if compat { Mode::Compat } else { Mode::Sound };
    let options = Options { mode, ..Options::default() };
    let job = compile(&program, Arc::new(MemoryFiles(files)), &options)
        .map_err(|found| ApiError::Program(program.clone(), found))?;
    let prepared =
        Prepared::of_step(&job).map_err(|failure| ApiError::of_program(&program, failure))?;
    checked(prepared)
}

/// Errors of values show when the model is built: now rather than at every table.
fn checked(prepared: Prepared) -> Result<Prepared, ApiError> {
    prepared.model()?;
    Ok(prepared)
}

/// `GET /v1/materials`
pub(super) async fn list(State(app): State<App>) -> Json<Value> {
    let all = app.materials.0.read().expect("nobody panics with the lock");
    let each = |(name, kept): (&String, &Arc<Kept>)| json!({ "name": name, "hash": kept.hash });
    Json(Value::Array(all.iter().map(each).collect()))
}

/// `GET /v1/materials/{name}`
pub(super) async fn get(
    State(app): State<App>,
    Path(name): Path<String>,
) -> Result<([(axum::http::HeaderName, &'static str); 1], String), ApiError> {
    let kept = app.materials.find(&name)?;
    Ok(([(axum::http::header::CONTENT_TYPE, "application/json")], kept.text.clone()))
}

/// `DELETE /v1/materials/{name}`
pub(super) async fn delete(
    State(app): State<App>,
    Path(name): Path<String>,
) -> Result<StatusCode, ApiError> {
    let gone = app.materials.0.write().expect("nobody panics with the lock").remove(&name);
    gone.map(|_| StatusCode::NO_CONTENT)
        .ok_or_else(|| ApiError::NotFound(format!("material {name}")))
}
