//! Errors of exports and of reading exported files.

use std::io;

use mist_engine::{material::MaterialError, request::RequestError};

use crate::tensor::TensorError;

/// Errors of exporting a material or reading an exported file.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// The format cannot hold the material or the request, or the file is invalid.
    #[error("{part}: {problem}")]
    Refused {
        /// The part of the request, the material or the file.
        part: String,
        /// The reason, and what is accepted.
        problem: String,
    },
    /// The material is invalid.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// The tensor file is invalid.
    #[error(transparent)]
    Tensor(#[from] TensorError),
    /// The file cannot be written.
    #[error("cannot write the file: {0}")]
    Io(#[from] io::Error),
    /// The export was cancelled.
    #[error("cancelled")]
    Cancelled,
}

impl From<RequestError> for ExportError {
    fn from(error: RequestError) -> Self {
        Self::Material(error.into())
    }
}

impl ExportError {
    /// A refusal of `part`.
    pub fn refused(part: &str, problem: impl Into<String>) -> Self {
        Self::Refused { part: part.to_owned(), problem: problem.into() }
    }
}
