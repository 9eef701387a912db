//! Reasons to refuse a request for a job.

use crate::{limits::LimitReached, store::StoreError};

/// The reason why a request for a job is refused.
#[derive(Debug)]
pub(crate) enum JobsError {
    /// No job has this id.
    Unknown(String),
    /// The service is stopping.
    Stopping,
    /// Too many jobs wait or are stored.
    Full(LimitReached),
    /// The store cannot be read or written.
    Store(StoreError),
    /// The system has no random numbers for an id.
    NoRandomNumbers(String),
}

impl From<StoreError> for JobsError {
    fn from(error: StoreError) -> Self {
        Self::Store(error)
    }
}
