//! Errors of a request.

use std::fmt::Display;

use thiserror::Error;

/// An error of a request, with its case and its field.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{}{}{problem}", located("case", case), located("field", field))]
pub struct CaseError {
    /// The `id` of the case or its number from 1; empty for the request itself.
    pub case: String,
    /// Path of the field, such as `filters[1].angle_deg`; empty for the case itself.
    pub field: String,
    /// The problem, and what is accepted.
    pub problem: String,
}

fn located(what: &str, name: &str) -> String {
    if name.is_empty() { String::new() } else { format!("{what} `{name}`: ") }
}

impl CaseError {
    pub(super) fn new(case: &str, field: &str, problem: impl Display) -> Self {
        Self { case: case.to_owned(), field: field.to_owned(), problem: problem.to_string() }
    }
}
