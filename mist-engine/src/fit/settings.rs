//! Settings of a fit.

use std::collections::BTreeMap;

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
