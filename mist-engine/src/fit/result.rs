//! The result of a fit: values, intervals and residuals.

use serde::Serialize;

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
