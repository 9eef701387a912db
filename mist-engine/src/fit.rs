//! Fitting variables of a program to measured values, by least squares.
//!
//! $$ \chi^2(\mathbf{p}) = \sum_i \left(\frac{y_i - f_i(\mathbf{p})}{\sigma_i}\right)^2 $$
//!
//! is made least over the variables **p** by the Levenberg–Marquardt method of the crate
//! `rmpfit`. The f are outputs of the program, so the aperture of the instrument and whatever else
//! the program integrates over is part of the fit. The derivatives are central differences.
//!
//! With ν = data − variables, s² = χ²/ν and J the derivatives of the weighted residuals, the
//! covariance of the variables is s² (JᵀJ)⁻¹ and a variable's interval is its value ± t √C_ii with
//! Student's t for ν; with σ that are known ([`FitSettings::absolute`]), (JᵀJ)⁻¹ and the normal
//! distribution.
//!
//! Limits: the intervals are those of a model that is linear near the solution, with independent
//! errors. A minimum is a local one: it depends on the start.
//!
//! J. J. Moré, in *Numerical Analysis*, Lect. Notes Math. 630, 105 (1978); C. B. Markwardt, ASP
//! Conf. Ser. 411, 251 (2009).

mod covariance;
mod measured;
mod solve;

use std::collections::BTreeMap;

use mist_format::Diagnostic;
use serde::Serialize;

use crate::{Control, Failure, function::ProgramFunction};

pub use measured::{Datum, MeasuredError, MeasuredTable};

/// Settings of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct FitSettings {
    /// Initial values of variables, in place of the program's values.
    pub start: BTreeMap<String, f64>,
    /// The least and the largest value that variables may have.
    pub bounds: BTreeMap<String, [f64; 2]>,
    /// Step of the differences, relative to the value.
    pub step: f64,
    /// Probability that an interval covers the true value.
    pub confidence: f64,
    /// The uncertainties of the data are standard deviations, not only weights.
    pub absolute: bool,
    /// Iterations at most.
    pub iterations: usize,
}

impl Default for FitSettings {
    fn default() -> Self {
        Self {
            start: BTreeMap::new(),
            bounds: BTreeMap::new(),
            step: 1e-4,
            confidence: 0.95,
            absolute: false,
            iterations: 100,
        }
    }
}

/// A variable after a fit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fitted {
    /// Its name in the program.
    pub name: String,
    /// Initial value.
    pub start: f64,
    /// Its best value.
    pub value: f64,
    /// Standard error; none for a variable at its bound.
    pub standard_error: Option<f64>,
    /// The interval that covers the true value with the wanted probability.
    pub interval: Option<[f64; 2]>,
    /// True if it ended at one of its bounds.
    pub at_bound: bool,
}

/// Residuals between the data and the program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Residuals {
    /// Number of data.
    pub data: usize,
    /// Data minus fitted variables.
    pub degrees_of_freedom: usize,
    /// Sum of the squared weighted residuals.
    pub chi_squared: f64,
    /// χ² over the degrees of freedom.
    pub reduced_chi_squared: f64,
    /// Root of the mean square of measured minus computed, without weights.
    pub rms: f64,
    /// The largest |measured − computed|/σ in units of √(χ²/ν).
    pub largest: f64,
    /// The row of the measured file, from 1, and the column with the largest.
    pub largest_at: (usize, String),
    /// Correlation of measured and computed values; none if either does not vary.
    pub correlation: Option<f64>,
}

/// The result of a fit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fit {
    /// The variables in the order they were named.
    pub parameters: Vec<Fitted>,
    /// Probability of the intervals.
    pub confidence: f64,
    /// True if the uncertainties were taken as standard deviations.
    pub absolute: bool,
    /// Correlation matrix of the variables; those at a bound have zeros.
    pub correlation: Vec<Vec<f64>>,
    /// Residuals.
    pub residuals: Residuals,
    /// Iterations it took.
    pub iterations: usize,
    /// Runs of the program.
    pub runs: usize,
    /// Columns of the measured file that were not used.
    pub ignored: Vec<String>,
}

/// Why there is no fit.
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
        /// Why not.
        failure: Failure,
    },
    /// An output is no finite number.
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

/// Fits the variables of `program` to `measured`.
///
/// # Errors
///
/// See [`FitError`].
pub fn fit(
    program: &ProgramFunction,
    measured: &MeasuredTable,
    settings: &FitSettings,
    control: &Control,
) -> Result<Fit, FitError> {
    solve::LeastSquares::new(program, measured, settings, control)?.solve()
}

#[cfg(test)]
mod tests;
