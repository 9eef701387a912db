//! Errors of tensor files.

use std::io;

/// Errors of reading a tensor file.
#[derive(Debug, thiserror::Error)]
pub enum TensorError {
    /// The first bytes are not those of the format.
    #[error("not a tensor file: it does not begin with \"tensor_file\"")]
    NotATensor,
    /// The version is not supported.
    #[error("tensor file of version {0}.{1}; expected 1.0")]
    Version(u8, u8),
    /// The header is invalid, or the file ends before its data.
    #[error("the tensor file is damaged or truncated: {0}")]
    Damaged(String),
    /// A field is missing, or has an unexpected shape or type.
    #[error("field {name}: {problem}")]
    Field {
        /// Its name.
        name: String,
        /// The problem, and what is expected.
        problem: String,
    },
    /// It cannot be read or written.
    #[error(transparent)]
    Io(#[from] io::Error),
}

impl TensorError {
    /// An error of the field `name`.
    pub fn field(name: &str, problem: impl Into<String>) -> Self {
        Self::Field { name: name.to_owned(), problem: problem.into() }
    }
}
