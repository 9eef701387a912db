//! Single geometries: angles as JSON, or the vectors of a renderer as bytes.

use std::{sync::Arc, time::Duration};

use axum::{
    Json,
    extract::State,
    http::{Uri, header},
    response::{IntoResponse, Response},
};
use glam::DVec3;
use mist_engine::{
    Control,
    material::{
        MaterialError, eval,
        lobes::{LobeOutput, Lobes},
    },
    request::{EvaluationRequest, MaterialDescription},
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
    compute::WorkSize,
    limits::{LimitReached, ServeLimits},
    materials::StoredMaterial,
    program::admit as admit_program,
};

/// Bytes of a pair of vectors: six f32.
const PAIR: usize = 24;
/// Evaluations of a part of the work for one thread.
const AT_ONCE: usize = 1024;
/// Evaluations of a small answer.
const SMALL: usize = 200_000;
/// Work that is done at once, on the thread that answers.
const AT_ONCE_TIME: Duration = Duration::from_millis(1);

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
    operation_id = "evaluate_model",
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
    let request: EvaluationRequest = serde_json::from_str(&body).map_err(MaterialError::Json)?;
    if let MaterialDescription::Program(program) = &request.material {
        admit_program(program, &client.limits)?;
    }
    let evaluations = request.evaluations();
    refuse_more(evaluations, "evaluations", ("max-evaluations", client.limits.max_evaluations))?;
    let size = if evaluations <= AT_ONCE { WorkSize::Small } else { WorkSize::Large };
    let work = move |_: &Control| eval::answer(request, mode, None);
    let response = app.compute_in_time(&client, size, work).await??;
    Ok(Json(response).into_response())
}

/// Values of a material for pairs of vectors: f32 little-endian `[n][6]` (to the source, to the
/// viewer; z is the normal, x the fiducial axis) in, f32 `[n][3 | wavelengths | 16 wavelengths]`
/// out, in 1/sr and without the cosine.
#[utoipa::path(
    post,
    path = "/v1/materials/{name}/evaluate",
    operation_id = "evaluate_material",
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
    let (lobes, out) = (&prepared.lobes, prepared.out);
    admit(&client.limits, lobes, pairs.len(), out)?;
    let evaluations = pairs.len() * lobes.wavelengths();
    app.metrics.count_evaluations(evaluations);
    let answer = if prepared.expected_time(evaluations) <= AT_ONCE_TIME {
        lobes.evaluate(&pairs, out)
    } else {
        let size = if evaluations <= SMALL { WorkSize::Small } else { WorkSize::Large };
        let work = move |_: &Control| {
            prepared.measured(evaluations, |lobes| in_parallel(lobes, &pairs, out))
        };
        app.compute_in_time(&client, size, work).await?
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
    let build = move |_: &Control| Lobes::new(&kept.prepared, &view);
    let made = app.compute_in_time(client, WorkSize::Small, build).await??;
    made.check(out)?;
    Ok(app.lobes.insert(key, PreparedLobes::new(made, out)))
}

fn admit(
    limits: &ServeLimits,
    lobes: &Lobes,
    pairs: usize,
    out: LobeOutput,
) -> Result<(), ApiError> {
    let (evaluations, numbers) = (pairs * lobes.wavelengths(), pairs * lobes.width(out));
    refuse_more(evaluations, "evaluations", ("max-evaluations", limits.max_evaluations))?;
    refuse_more(numbers, "numbers", ("max-numbers", limits.max_numbers))
}

/// Refuses a `count` above the `value` of the limit `flag`.
fn refuse_more(
    count: usize,
    what: &str,
    (flag, value): (&'static str, f64),
) -> Result<(), ApiError> {
    if count as f64 <= value {
        return Ok(());
    }
    let message = format!("the answer needs {count} {what}, more than {value}");
    Err(ApiError::Limit(LimitReached { flag, value, message }))
}

/// Pieces of the work on all threads.
fn in_parallel(lobes: &Lobes, pairs: &[(DVec3, DVec3)], out: LobeOutput) -> Vec<f32> {
    use rayon::prelude::*;
    let parts: Vec<Vec<f32>> =
        pairs.par_chunks(AT_ONCE).map(|pairs| lobes.evaluate(pairs, out)).collect();
    parts.concat()
}
