//! Errors of requests, as data.

use std::{fmt::Display, str::FromStr};

use mist_format::number::whole_number;
use thiserror::Error;

/// A text that is not of the expected form.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{text:?}: expected {expected}")]
pub struct InvalidText {
    /// The text, or the part of it at fault.
    pub text: String,
    /// The form that is accepted.
    pub expected: String,
}

impl InvalidText {
    /// The error of `text` where `expected` is accepted.
    pub fn new(text: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { text: text.into(), expected: expected.into() }
    }
}

/// A part of a request that is wrong.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{key}: {problem}")]
pub struct RequestError {
    /// The key of the part: that of the URL, of the JSON object, or the flag without dashes.
    pub key: String,
    /// The reason, and what is accepted.
    pub problem: String,
}

impl RequestError {
    /// The error of the part called `key`.
    pub fn new(key: impl Into<String>, problem: impl Display) -> Self {
        Self { key: key.into(), problem: problem.to_string() }
    }
}

/// Reads the value of `key` from its text.
///
/// # Errors
///
/// If the text is not of the form of the value; the error names `key`.
pub fn read<T>(key: &str, text: &str) -> Result<T, RequestError>
where
    T: FromStr,
    T::Err: Display,
{
    text.parse().map_err(|error| RequestError::new(key, error))
}

/// A finite number.
pub(super) fn number(text: &str) -> Result<f64, InvalidText> {
    let found = whole_number(text.trim()).filter(|x| x.is_finite());
    found.ok_or_else(|| InvalidText::new(text.trim(), "a number"))
}
