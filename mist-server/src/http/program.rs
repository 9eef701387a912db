//! Programs in the bodies of requests: JSON with data files, or the bare text.

use axum::extract::{FromRequest, Request};
use mist_engine::request::ProgramDescription;

use super::{error::ApiError, extract::MistText, state::App};
use crate::program::admit;

/// The program in the body of a request; it is not too long.
pub(super) struct ProgramRequest(pub(super) ProgramDescription);

impl FromRequest<App> for ProgramRequest {
    type Rejection = ApiError;

    async fn from_request(request: Request, app: &App) -> Result<Self, ApiError> {
        let MistText { text, is_json } = MistText::from_request(request, app).await?;
        let program = if is_json {
            serde_json::from_str(&text)
                .map_err(|error| ApiError::Body(format!("not a program with its files: {error}")))?
        } else {
            ProgramDescription::bare(text)
        };
        admit(&program, &app.limits)?;
        Ok(Self(program))
    }
}
