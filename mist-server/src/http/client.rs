//! The client of a request: its name, and the permission that it has.

use std::sync::Arc;

use axum::{
    extract::FromRequestParts,
    http::{StatusCode, request::Parts},
};

use super::{error::ApiError, problem::Problem};
use crate::{
    keys::KeyScope,
    limits::{LimitReached, ServeLimits},
};

/// The client: the name of a key, or an address.
#[derive(Clone, Debug)]
pub(super) struct Client {
    /// Name of the key, or the address.
    pub(super) name: String,
    /// The permission.
    pub(super) scope: KeyScope,
    /// The limits of its computations.
    pub(super) limits: Arc<ServeLimits>,
}

impl<S: Send + Sync> FromRequestParts<S> for Client {
    type Rejection = ApiError;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, ApiError> {
        let own = parts.extensions.get::<Self>().cloned();
        own.ok_or_else(|| ApiError::Failed("the request has no client".into()))
    }
}

impl Client {
    /// The error of work that takes longer than one answer may.
    pub(super) fn too_long(&self) -> ApiError {
        let value = self.limits.max_time;
        let message = format!("the answer takes longer than {value} s");
        ApiError::Limit(LimitReached { flag: "max-time", value, message })
    }

    /// Refuses to change what `owner` has created, unless the client is `owner` or has the scope
    /// `admin`.
    ///
    /// # Errors
    ///
    /// 403.
    pub(super) fn may_change(&self, owner: Option<&str>, what: &str) -> Result<(), ApiError> {
        if self.scope == KeyScope::Admin || owner.is_none_or(|owner| owner == self.name) {
            return Ok(());
        }
        let message = format!("{what} belongs to another client");
        let mut problem = Problem::new(StatusCode::FORBIDDEN, "owner", message);
        problem.help = Some("use another name, or a key with the scope admin".into());
        Err(ApiError::Problem(Box::new(problem)))
    }
}
