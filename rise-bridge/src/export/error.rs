//! Why a material cannot be exported.

use std::io;

use mist_engine::material::MaterialError;

use crate::tensor::TensorError;

/// Why a material cannot be exported, or a file not be read.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// The format has no room for what is asked.
    #[error("{part}: {problem}")]
    Refused {
        /// Which part of the request or of the material.
        part: String,
        /// Why not, and what would do.
        problem: String,
    },
    /// The material itself.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// A tensor file that is read.
    #[error(transparent)]
    Tensor(#[from] TensorError),
    /// The file cannot be written.
    #[error("cannot write the file: {0}")]
    Io(#[from] io::Error),
    /// It was stopped from outside.
    #[error("cancelled")]
    Cancelled,
}

impl ExportError {
    /// A part that the format has no room for.
    pub fn refused(part: &str, problem: impl Into<String>) -> Self {
        Self::Refused { part: part.to_owned(), problem: problem.into() }
    }
}
