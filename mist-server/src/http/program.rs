//! Programs in the bodies of requests: JSON, multipart, or the bare text.

use axum::{
    extract::{FromRequest, Multipart, Request},
    http::{StatusCode, header},
};
use mist_runner::files::decode;

use super::{error::ApiError, extract::BodyText, state::App};
use crate::{
    limits::{LimitReached, ServeLimits},
    program::ProgramRequest,
};

/// Media types of bodies that are the text of a program, or JSON: those of simple clients.
const TEXTS: [&str; 3] = ["text/", "application/octet-stream", "application/x-www-form-urlencoded"];

fn from_json(text: &str) -> Result<ProgramRequest, ApiError> {
    let read = serde_json::from_str(text);
    read.map_err(|error| ApiError::Body(format!("not a program with its files: {error}")))
}

/// Takes the parts `program`, `compat`, `job`, `seed`; every other part is a data file.
async fn from_parts(
    mut parts: Multipart,
    limits: &ServeLimits,
) -> Result<ProgramRequest, ApiError> {
    let unreadable = |error: axum::extract::multipart::MultipartError| {
        if error.status() == StatusCode::PAYLOAD_TOO_LARGE {
            let most = limits.max_body;
            let message = format!("the body has more than {most} bytes");
            return ApiError::TooLarge(LimitReached {
                flag: "max-body",
                value: most as f64,
                message,
            });
        }
        ApiError::Body(error.body_text())
    };
    let mut body = ProgramRequest::default();
    let mut has_program = false;
    while let Some(part) = parts.next_field().await.map_err(unreadable)? {
        let name = part.name().unwrap_or_default().to_owned();
        let file = part.file_name().map(str::to_owned);
        let text = decode(part.bytes().await.map_err(unreadable)?.into());
        match name.as_str() {
            "program" => (body.program, has_program) = (text, true),
            "compat" => body.compat = is_yes(&text),
            "job" => body.job = Some(text.trim().to_owned()),
            "seed" => {
                let seed = text.trim().parse();
                body.seed = Some(seed.map_err(|_| {
                    ApiError::Body(format!("seed: {:?} is no whole number", text.trim()))
                })?);
            }
            _ => {
                body.files.insert(file.unwrap_or(name), text);
            }
        }
    }
    if has_program { Ok(body) } else { Err(ApiError::Body("the part `program` is missing".into())) }
}

fn is_yes(text: &str) -> bool {
    matches!(text.trim(), "1" | "true" | "yes" | "on")
}

impl FromRequest<App> for ProgramRequest {
    type Rejection = ApiError;

    async fn from_request(request: Request, app: &App) -> Result<Self, ApiError> {
        let kind = request.headers().get(header::CONTENT_TYPE).and_then(|kind| kind.to_str().ok());
        let kind = kind.unwrap_or("").to_ascii_lowercase();
        let body = if kind.starts_with("multipart/form-data") {
            let parts = Multipart::from_request(request, app)
                .await
                .map_err(|error| ApiError::Body(error.body_text()))?;
            let read = from_parts(parts, &app.limits);
            tokio::time::timeout(app.limits.silence(), read).await.map_err(|_| ApiError::Slow)??
        } else if kind.starts_with("application/json") {
            let BodyText(text) = BodyText::from_request(request, app).await?;
            from_json(&text)?
        } else if TEXTS.iter().any(|text| kind.starts_with(text)) || kind.is_empty() {
            let BodyText(text) = BodyText::from_request(request, app).await?;
            let is_json = text.trim_start().starts_with('{');
            if is_json { from_json(&text)? } else { Self::bare(text) }
        } else {
            let known = "multipart/form-data, application/json or text/plain";
            return Err(ApiError::MediaType(format!("{kind}: send the program as {known}")));
        };
        body.admit(&app.limits)?;
        Ok(body)
    }
}
