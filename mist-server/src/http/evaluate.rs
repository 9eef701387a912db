//! Single geometries: angles as JSON, or the vectors of a renderer as bytes.

use std::sync::Arc;

use axum::{
    Json,
    extract::State,
    http::{Uri, header},
    response::{IntoResponse, Response},
};
use glam::DVec3;
use mist_engine::material::{
    eval,
    lobes::{LobeOutput, Lobes},
};
use scattering::Mode;
use serde::Deserialize;
use utoipa::IntoParams;

use super::{
    client::Client,
    error::ApiError,
    extract::{JsonText, PathParameters, Query, VectorBytes},
    prepared_lobes::PreparedLobes,
    problem::Problems,
    query::MaterialQuery,
    schema,
    state::App,
};
use crate::{
    limits::{LimitReached, ServeLimits},
    materials::StoredMaterial,
};

/// Bytes of a pair of vectors: six f32.
const PAIR: usize = 24;
/// Evaluations that are done at once, on the thread that answers: some hundred microseconds.
const AT_ONCE: usize = 1024;

/// The options of `mist eval`.
#[derive(Default, Deserialize, IntoParams)]
#[serde(deny_unknown_fields, default)]
#[into_params(parameter_in = Query)]
pub(super) struct EvaluationOptions {
    /// Give NIST's numbers, its defects included.
    compat: bool,
}

/// Mueller matrices of a model in given directions, as `mist eval` gives them.
#[utoipa::path(
    post,
    path = "/v1/evaluate",
    tag = "evaluate",
    params(EvaluationOptions),
    request_body = schema::EvalRequest,
    responses((status = 200, description = "One matrix per geometry, 1/sr", body = schema::EvalAnswer), Problems),
)]
pub(super) async fn angles(
    State(app): State<App>,
    Query(options): Query<EvaluationOptions>,
    client: Client,
    JsonText(body): JsonText,
) -> Result<Response, ApiError> {
    let mode = if options.compat { Mode::Compat } else { Mode::Sound };
    let work = move || eval::eval(&body, mode, None);
    let response = app.compute_in_time(&client, work).await??;
    Ok(Json(response).into_response())
}

/// Values of a material for pairs of vectors: f32 little-endian `[n][6]` (to the source, to the
/// viewer; z is the normal, x the fiducial axis) in, f32 `[n][3 | wavelengths | 16 wavelengths]`
/// out, in 1/sr and without the cosine.
#[utoipa::path(
    post,
    path = "/v1/materials/{name}/evaluate",
    tag = "materials",
    params(schema::MaterialName, MaterialQuery),
    request_body(content = Vec<u8>, content_type = "application/octet-stream"),
    responses(
        (status = 200, description = "The numbers", body = Vec<u8>, content_type = "application/octet-stream"),
        Problems,
    ),
)]
pub(super) async fn vectors(
    State(app): State<App>,
    PathParameters(name): PathParameters<String>,
    client: Client,
    uri: Uri,
    VectorBytes(body): VectorBytes,
) -> Result<Response, ApiError> {
    let pairs = pairs(&body)?;
    let kept = app.materials.find(&name)?;
    let prepared = prepared(&app, &client, kept, &uri).await?;
    let PreparedLobes { lobes, out } = &*prepared;
    let out = *out;
    admit(&client.limits, lobes, pairs.len(), out)?;
    let evaluations = pairs.len() * lobes.wavelengths();
    app.metrics.count_evaluations(evaluations);
    let answer = if evaluations <= AT_ONCE {
        lobes.evaluate(&pairs, out)
    } else {
        app.compute_in_time(&client, move || in_parallel(&prepared.lobes, &pairs, out)).await?
    };
    let mut bytes = Vec::with_capacity(4 * answer.len());
    for x in &answer {
        bytes.extend_from_slice(&x.to_le_bytes());
    }
    Ok(([(header::CONTENT_TYPE, "application/octet-stream")], bytes).into_response())
}

/// The vectors in a body.
fn pairs(body: &[u8]) -> Result<Vec<(DVec3, DVec3)>, ApiError> {
    if !body.len().is_multiple_of(PAIR) {
        let message = format!(
            "the body has {} bytes; expected 24 for each pair: six f32, little-endian",
            body.len()
        );
        return Err(ApiError::Body(message));
    }
    let vector = |bytes: &[u8]| {
        let x = |k: usize| {
            let bytes = [bytes[k], bytes[k + 1], bytes[k + 2], bytes[k + 3]];
            f64::from(f32::from_le_bytes(bytes))
        };
        DVec3::new(x(0), x(4), x(8))
    };
    Ok(body.chunks_exact(PAIR).map(|pair| (vector(&pair[..12]), vector(&pair[12..]))).collect())
}

/// The lobes that the query asks for, from the cache or new.
async fn prepared(
    app: &App,
    client: &Client,
    kept: Arc<StoredMaterial>,
    uri: &Uri,
) -> Result<Arc<PreparedLobes>, ApiError> {
    // The text of the query has everything: it is read once.
    let key = format!("{} {}", kept.hash, uri.query().unwrap_or_default());
    if let Some(found) = app.lobes.get(&key) {
        return Ok(found);
    }
    let query = MaterialQuery::of(uri)?;
    let out = LobeOutput::parse(query.out().unwrap_or("rgb"))?;
    let view = query.view(&client.limits)?;
    let made = app.compute_in_time(client, move || Lobes::new(&kept.prepared, &view)).await??;
    made.check(out)?;
    Ok(app.lobes.insert(key, PreparedLobes { lobes: made, out }))
}

fn admit(
    limits: &ServeLimits,
    lobes: &Lobes,
    pairs: usize,
    out: LobeOutput,
) -> Result<(), ApiError> {
    let (evaluations, numbers) = (pairs * lobes.wavelengths(), pairs * lobes.width(out));
    for (count, what, flag, value) in [
        (evaluations, "evaluations", "max-evaluations", limits.max_evaluations),
        (numbers, "numbers", "max-numbers", limits.max_numbers),
    ] {
        if count as f64 > value {
            let message = format!("the answer needs {count} {what}, more than {value}");
            return Err(ApiError::Limit(LimitReached { flag, value, message }));
        }
    }
    Ok(())
}

/// Pieces of the work on all threads.
fn in_parallel(lobes: &Lobes, pairs: &[(DVec3, DVec3)], out: LobeOutput) -> Vec<f32> {
    use rayon::prelude::*;
    let parts: Vec<Vec<f32>> =
        pairs.par_chunks(AT_ONCE).map(|pairs| lobes.evaluate(pairs, out)).collect();
    parts.concat()
}
