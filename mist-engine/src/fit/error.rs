//! Errors of fits.

use mist_format::Diagnostic;

use super::measured::MeasuredError;
use crate::Failure;

/// Error of a fit.
#[derive(Debug, thiserror::Error)]
pub enum FitError {
    /// A setting names something that is not varied, or has an impossible value.
    #[error("{name}: {problem}")]
    Setting {
        /// Which.
        name: String,
        /// Description of the error.
        problem: String,
    },
    /// There are not more data than variables.
    #[error(
        "{data} data cannot determine {variables} variables and their uncertainty: at least \
         {} are needed", .variables + 1
    )]
    TooFewData {
        /// Usable data.
        data: usize,
        /// Variables.
        variables: usize,
    },
    /// The measured rows do not fit the program's.
    #[error("{0}")]
    MeasuredTable(#[from] MeasuredError),
    /// The program does not run.
    #[error("with {}: {failure}", named(.values))]
    Run {
        /// The variables.
        values: Vec<(String, f64)>,
        /// The reason.
        failure: Failure,
    },
    /// An output is not a finite number.
    #[error("with {}: the output {output:?} is {value}", named(.values))]
    NotFinite {
        /// The variables.
        values: Vec<(String, f64)>,
        /// The output.
        output: String,
        /// Its value.
        value: f64,
    },
    /// A variable changes nothing, or nothing that the others do not change in the same way.
    #[error("{}", undetermined(.name, .with))]
    NotIdentifiable {
        /// The variable.
        name: String,
        /// The variables that can take its place.
        with: Vec<String>,
    },
    /// The iterations did not end.
    #[error(
        "no minimum after {iterations} iterations, which came to {}; start nearer, set bounds, or \
         allow more iterations",
        named(.values)
    )]
    NotConverged {
        /// Iterations.
        iterations: usize,
        /// The best values.
        values: Vec<(String, f64)>,
    },
    /// It was stopped from outside.
    #[error("the fit was cancelled")]
    Cancelled,
}

impl FitError {
    /// Diagnostics of the program, if it is the reason.
    pub fn diagnostics(&self) -> Option<&[Diagnostic]> {
        match self {
            Self::Run { failure: Failure::Program(diagnostics), .. } => Some(diagnostics),
            _ => None,
        }
    }
}

fn named(values: &[(String, f64)]) -> String {
    let each: Vec<String> =
        values.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    each.join(", ")
}

fn undetermined(name: &str, with: &[String]) -> String {
    let why = match with {
        [] => "nothing that was measured depends on it".to_owned(),
        others => {
            format!("a change of {} does the same to the measured columns", others.join(", "))
        }
    };
    format!("{name} cannot be determined: {why}; vary fewer variables or measure more")
}
