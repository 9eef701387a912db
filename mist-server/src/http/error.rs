//! Errors of requests, and their answers: `application/problem+json`.

use axum::{
    Json,
    http::{HeaderValue, StatusCode, header},
    response::{IntoResponse, Response},
};
use mist_engine::{material::MaterialError, request::RequestError};

use super::{media::MIST, problem::Problem};
use crate::{
    failure::FailureReport, jobs::JobsError, limits::LimitReached, materials::MaterialsError,
    memory::MemoryError, program::ProgramError, store::StoreError,
};

/// Seconds after which a client may ask again.
const RETRY_AFTER: u32 = 2;

/// The reason why a request was not answered.
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
    MediaType {
        /// The kind that was sent.
        message: String,
        /// The kinds that are read.
        expected: String,
    },
    /// It is not in a state for that.
    Conflict(String),
    /// A limit: the flag, its value, what broke it.
    TooLarge(LimitReached),
    /// A limit that other values would keep.
    Limit(LimitReached),
    /// A limit of the client that time will lift.
    TooMany(LimitReached),
    /// The service has too much to do.
    Busy(LimitReached),
    /// The service is stopping.
    Unavailable(String),
    /// The store cannot be read or written.
    Store(String),
    /// A problem that is ready to be sent.
    Problem(Box<Problem>),
    /// The work failed.
    Failed(String),
}

impl From<RequestError> for ApiError {
    fn from(error: RequestError) -> Self {
        MaterialError::from(error).into()
    }
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
        Self::Problem(Box::new(problem))
    }
}

impl From<StoreError> for ApiError {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::Damaged(_) => Self::Failed(error.to_string()),
            _ => Self::Store(error.to_string()),
        }
    }
}

impl From<MemoryError> for ApiError {
    fn from(error: MemoryError) -> Self {
        match error {
            MemoryError::TooLarge(limit) => Self::Limit(limit),
            MemoryError::Exhausted(limit) => Self::Busy(limit),
        }
    }
}

impl From<JobsError> for ApiError {
    fn from(error: JobsError) -> Self {
        match error {
            JobsError::Unknown(id) => Self::NotFound(format!("job {id:?}")),
            JobsError::Stopping => Self::Unavailable("the service is stopping".into()),
            JobsError::Full(limit) => Self::TooMany(limit),
            JobsError::Store(error) => error.into(),
            JobsError::NoRandomNumbers(message) => Self::Failed(message),
        }
    }
}

impl From<MaterialsError> for ApiError {
    fn from(error: MaterialsError) -> Self {
        match error {
            MaterialsError::Unknown(name) => Self::NotFound(format!("material {name:?}")),
            MaterialsError::Material(error) => error.into(),
            MaterialsError::Program(error) => error.into(),
        }
    }
}

impl From<ProgramError> for ApiError {
    fn from(error: ProgramError) -> Self {
        let wrong = |report| {
            let problem = Problem::of(StatusCode::UNPROCESSABLE_ENTITY, report);
            Self::Problem(Box::new(problem))
        };
        match error {
            ProgramError::TooLarge(limit) => Self::TooLarge(limit),
            ProgramError::Wrong(report) => wrong(*report),
            ProgramError::Limit(_) => wrong(error.report()),
            ProgramError::OutputTooLong(limit) => Self::Limit(limit),
            ProgramError::Cancelled(message) | ProgramError::Storage(message) => {
                Self::Unavailable(message)
            }
        }
    }
}

impl ApiError {
    /// The problem that the client gets.
    pub(crate) fn problem(self) -> Problem {
        let limited =
            |status, code, limit| Problem::of(status, FailureReport::of_limit(code, limit));
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
            Self::MediaType { message, expected } => {
                let status = StatusCode::UNSUPPORTED_MEDIA_TYPE;
                let mut problem = Problem::new(status, "content-type", message);
                let files = "; a program with its data files is JSON {\"program\": TEXT, \
                             \"files\": {NAME: TEXT}}";
                let files = if expected.contains(MIST) { files } else { "" };
                problem.help = Some(format!("send the header `Content-Type: {expected}`{files}"));
                problem
            }
            Self::Conflict(message) => Problem::new(StatusCode::CONFLICT, "state", message),
            Self::TooLarge(limit) => limited(StatusCode::PAYLOAD_TOO_LARGE, "too-large", limit),
            Self::Limit(limit) => limited(StatusCode::UNPROCESSABLE_ENTITY, "limit", limit),
            Self::TooMany(limit) => limited(StatusCode::TOO_MANY_REQUESTS, "too-many", limit),
            Self::Busy(limit) => limited(StatusCode::SERVICE_UNAVAILABLE, "busy", limit),
            Self::Unavailable(message) => {
                Problem::new(StatusCode::SERVICE_UNAVAILABLE, "unavailable", message)
            }
            Self::Store(message) => {
                Problem::new(StatusCode::INSUFFICIENT_STORAGE, "unavailable", message)
            }
            Self::Problem(problem) => *problem,
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
            StatusCode::TOO_MANY_REQUESTS
            | StatusCode::SERVICE_UNAVAILABLE
            | StatusCode::INSUFFICIENT_STORAGE => {
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
