//! A program with its data files in the body of a request: JSON, multipart, or the bare text.

use std::{collections::BTreeMap, sync::Arc};

use axum::{
    extract::{FromRequest, Multipart, Request},
    http::{StatusCode, header},
};
use mist_engine::{Failure, Files, Job, MemoryFiles, Options, compile};
use mist_format::program::count_tokens;
use mist_runner::files::decode;
use scattering::Mode;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::{
    App,
    error::{ApiError, Limit},
    extract::Text,
};
use crate::limits::ServeLimits;

/// Kinds of bodies that are the text of a program, or JSON: what simple clients send.
const TEXTS: [&str; 3] = ["text/", "application/octet-stream", "application/x-www-form-urlencoded"];

/// A program with its data files; it sees no others.
#[derive(Clone, Debug, Default, Deserialize, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ProgramBody {
    /// The text of the program.
    pub(crate) program: String,
    /// Texts of data files by the names that the program gives them.
    #[serde(default)]
    pub(crate) files: BTreeMap<String, String>,
    /// Give NIST's tables, its defects included.
    #[serde(default)]
    pub(crate) compat: bool,
    /// Name of the job.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) job: Option<String>,
    /// Seed of the Monte Carlo modes; 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) seed: Option<u64>,
}

impl ProgramBody {
    /// A program that needs no files.
    pub(crate) fn bare(program: String) -> Self {
        Self { program, ..Self::default() }
    }

    /// Refuses a program that is too long.
    pub(crate) fn admit(&self, limits: &ServeLimits) -> Result<(), ApiError> {
        let (bytes, tokens) = (self.program.len(), count_tokens(&self.program));
        for (count, most, what, flag) in [
            (bytes, limits.max_program, "bytes", "max-program"),
            (tokens, limits.max_tokens, "tokens", "max-tokens"),
        ] {
            if count > most {
                let message = format!("the program has {count} {what}, more than {most}");
                let limit = Limit { flag, value: most as f64, message };
                return Err(ApiError::TooLarge(limit));
            }
        }
        Ok(())
    }

    /// The files that were sent.
    pub(crate) fn files(&self) -> Arc<dyn Files + Send + Sync> {
        let each = |(name, text): (&String, &String)| (name.clone(), text.as_str().into());
        Arc::new(MemoryFiles(self.files.iter().map(each).collect()))
    }

    /// How the program is compiled and run.
    pub(crate) fn options(&self, limits: mist_engine::Limits) -> Options {
        Options {
            mode: if self.compat { Mode::Compat } else { Mode::Sound },
            job: self.job.clone().unwrap_or_else(|| "job".into()),
            seed: self.seed.unwrap_or(1),
            limits,
            ..Options::default()
        }
    }

    /// Compiles the program within `limits`.
    pub(crate) fn check(&self, limits: mist_engine::Limits) -> Result<Job, ApiError> {
        compile(&self.program, self.files(), &self.options(limits))
            .map_err(|found| ApiError::of_program(&self.program, Failure::Program(found)))
    }

    fn from_json(text: &str) -> Result<Self, ApiError> {
        let read = serde_json::from_str(text);
        read.map_err(|error| ApiError::Body(format!("not a program with its files: {error}")))
    }

    /// Takes the parts `program`, `compat`, `job`, `seed`; every other part is a data file.
    async fn from_parts(mut parts: Multipart, limits: &ServeLimits) -> Result<Self, ApiError> {
        let unreadable = |error: axum::extract::multipart::MultipartError| {
            if error.status() == StatusCode::PAYLOAD_TOO_LARGE {
                let most = limits.max_body;
                let message = format!("the body has more than {most} bytes");
                return ApiError::TooLarge(Limit { flag: "max-body", value: most as f64, message });
            }
            ApiError::Body(error.body_text())
        };
        let mut body = Self::default();
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
        if has_program {
            Ok(body)
        } else {
            Err(ApiError::Body("the part `program` is missing".into()))
        }
    }
}

fn is_yes(text: &str) -> bool {
    matches!(text.trim(), "1" | "true" | "yes" | "on")
}

impl FromRequest<App> for ProgramBody {
    type Rejection = ApiError;

    async fn from_request(request: Request, app: &App) -> Result<Self, ApiError> {
        let kind = request.headers().get(header::CONTENT_TYPE).and_then(|kind| kind.to_str().ok());
        let kind = kind.unwrap_or("").to_ascii_lowercase();
        let body = if kind.starts_with("multipart/form-data") {
            let parts = Multipart::from_request(request, app)
                .await
                .map_err(|error| ApiError::Body(error.body_text()))?;
            let read = Self::from_parts(parts, &app.limits);
            tokio::time::timeout(app.limits.silence(), read).await.map_err(|_| ApiError::Slow)??
        } else if kind.starts_with("application/json") {
            let Text(text) = Text::from_request(request, app).await?;
            Self::from_json(&text)?
        } else if TEXTS.iter().any(|text| kind.starts_with(text)) || kind.is_empty() {
            let Text(text) = Text::from_request(request, app).await?;
            let is_json = text.trim_start().starts_with('{');
            if is_json { Self::from_json(&text)? } else { Self::bare(text) }
        } else {
            let known = "multipart/form-data, application/json or text/plain";
            return Err(ApiError::Kind(format!("{kind}: send the program as {known}")));
        };
        body.admit(&app.limits)?;
        Ok(body)
    }
}
