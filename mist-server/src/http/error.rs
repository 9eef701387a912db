//! What a request gets instead of its answer: `application/problem+json`.

use axum::{
    Json,
    http::{HeaderValue, StatusCode, header},
    response::{IntoResponse, Response},
};
use mist_engine::{Failure, material::MaterialError};

use super::problem::{Problem, of_program};
use crate::{compute::NotDone, store::StoreError};

/// Seconds after which a client may ask again.
const RETRY_AFTER: u32 = 2;

/// Why a request was not answered.
#[derive(Clone, Debug)]
pub(crate) enum ApiError {
    /// Nothing has this name.
    NotFound(String),
    /// The query of the URL cannot be read.
    Query(String),
    /// The body cannot be read.
    Body(String),
    /// The body did not come in time.
    Slow,
    /// No key, or a wrong one.
    Key,
    /// The key is not for this; the scope that is needed.
    Scope(&'static str),
    /// The address has no such method.
    Method,
    /// The body is of a kind that is not read here.
    Kind(String),
    /// It is not in a state for that.
    Conflict(String),
    /// A limit: the flag, its value, what broke it.
    TooLarge(Limit),
    /// A limit that other values would keep.
    Limit(Limit),
    /// A limit of the client that time will lift.
    TooMany(Limit),
    /// The service has too much to do.
    Busy(Limit),
    /// The service is stopping, or what it keeps cannot be written.
    Unavailable(String),
    /// It was told before.
    Told(Box<Problem>),
    /// The work failed.
    Failed(String),
}

/// A limit of the service that was reached.
#[derive(Clone, Debug)]
pub(crate) struct Limit {
    /// The flag of `mist serve`, without dashes.
    pub(crate) flag: &'static str,
    /// Its value.
    pub(crate) value: f64,
    /// What happened.
    pub(crate) message: String,
}

impl From<MaterialError> for ApiError {
    fn from(error: MaterialError) -> Self {
        let status = match &error {
            MaterialError::Json(_) => StatusCode::BAD_REQUEST,
            MaterialError::Cancelled => return Self::Unavailable(error.to_string()),
            _ => StatusCode::UNPROCESSABLE_ENTITY,
        };
        let code = if let MaterialError::Limit(_) = &error { "limit" } else { "material" };
        let mut problem = Problem::new(status, code, error.to_string());
        problem.part = error.part().map(str::to_owned);
        problem.help = error.help().map(str::to_owned);
        Self::Told(Box::new(problem))
    }
}

impl From<StoreError> for ApiError {
    fn from(error: StoreError) -> Self {
        Self::Unavailable(error.to_string())
    }
}

impl From<NotDone> for ApiError {
    fn from(error: NotDone) -> Self {
        match error {
            NotDone::Panicked => Self::Failed(error.to_string()),
            NotDone::Busy(most) => Self::Busy(Limit {
                flag: "max-waiting",
                value: most as f64,
                message: "too many answers are being computed".into(),
            }),
        }
    }
}

impl ApiError {
    /// The failure of the program `text`.
    pub(crate) fn of_program(text: &str, failure: Failure) -> Self {
        let message = failure.to_string();
        match failure {
            Failure::Program(found) => Self::Told(Box::new(of_program(text, &found))),
            Failure::Step { step, fault } => {
                let note = format!("in step {}", step + 1);
                Self::Told(Box::new(of_program(text, &[fault.note(note)])))
            }
            Failure::Limit(message) => {
                let problem = Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "limit", message);
                Self::Told(Box::new(problem))
            }
            Failure::Cancelled => Self::Unavailable(message),
            Failure::Write(error) => match error.downcast::<OutputLimit>() {
                Ok(OutputLimit(limit)) => Self::Limit(limit),
                Err(error) => Self::Unavailable(format!("the results cannot be kept: {error}")),
            },
        }
    }

    /// What the client is told.
    pub(crate) fn problem(self) -> Problem {
        let limited = |status, code, limit: Limit| {
            let help = format!("the service was started with --{} {}", limit.flag, limit.value);
            let mut problem = Problem::new(status, code, limit.message);
            problem.limit = Some(limit.flag.to_owned());
            problem.help = Some(help);
            problem
        };
        match self {
            Self::NotFound(what) => {
                Problem::new(StatusCode::NOT_FOUND, "not-found", format!("there is no {what}"))
            }
            Self::Query(message) => Problem::new(StatusCode::BAD_REQUEST, "query", message),
            Self::Body(message) => Problem::new(StatusCode::BAD_REQUEST, "body", message),
            Self::Slow => {
                let message = "the body did not come in time";
                Problem::new(StatusCode::REQUEST_TIMEOUT, "slow", message)
            }
            Self::Key => {
                let mut problem =
                    Problem::new(StatusCode::UNAUTHORIZED, "key", "this needs a key that is known");
                problem.help = Some("send the header `Authorization: Bearer KEY`".into());
                problem
            }
            Self::Scope(scope) => {
                let message = format!("the key has no scope {scope}");
                Problem::new(StatusCode::FORBIDDEN, "scope", message)
            }
            Self::Method => {
                let message = "this address has no such method";
                Problem::new(StatusCode::METHOD_NOT_ALLOWED, "method", message)
            }
            Self::Kind(message) => {
                Problem::new(StatusCode::UNSUPPORTED_MEDIA_TYPE, "content-type", message)
            }
            Self::Conflict(message) => Problem::new(StatusCode::CONFLICT, "state", message),
            Self::TooLarge(limit) => limited(StatusCode::PAYLOAD_TOO_LARGE, "too-large", limit),
            Self::Limit(limit) => limited(StatusCode::UNPROCESSABLE_ENTITY, "limit", limit),
            Self::TooMany(limit) => limited(StatusCode::TOO_MANY_REQUESTS, "too-many", limit),
            Self::Busy(limit) => limited(StatusCode::SERVICE_UNAVAILABLE, "busy", limit),
            Self::Unavailable(message) => {
                Problem::new(StatusCode::SERVICE_UNAVAILABLE, "unavailable", message)
            }
            Self::Told(problem) => *problem,
            Self::Failed(message) => {
                Problem::new(StatusCode::INTERNAL_SERVER_ERROR, "failed", message)
            }
        }
    }
}

impl IntoResponse for ApiError {
    fn into_response(self) -> Response {
        let problem = self.problem();
        let status = StatusCode::from_u16(problem.status).unwrap_or(StatusCode::BAD_REQUEST);
        let kind = [(header::CONTENT_TYPE, "application/problem+json")];
        let mut response = (status, kind, Json(problem)).into_response();
        let headers = response.headers_mut();
        match status {
            StatusCode::TOO_MANY_REQUESTS | StatusCode::SERVICE_UNAVAILABLE => {
                headers.insert(header::RETRY_AFTER, HeaderValue::from(RETRY_AFTER));
            }
            StatusCode::UNAUTHORIZED => {
                let scheme = HeaderValue::from_static("Bearer");
                headers.insert(header::WWW_AUTHENTICATE, scheme);
            }
            _ => {}
        }
        response
    }
}

/// The texts of a run are longer than allowed: what its sink says to the engine.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{}", .0.message)]
pub(crate) struct OutputLimit(pub(crate) Limit);
