//! The summary of a finished run.

use std::collections::BTreeSet;

use mist_format::Diagnostic;
use scattering::Notice;

use crate::colour::ColourTable;

/// The summary of a finished run.
#[derive(Debug, Default)]
pub struct RunSummary {
    /// Steps of the loops.
    pub steps: u64,
    /// Evaluations of the model.
    pub evaluations: f64,
    /// Seconds it took.
    pub seconds: f64,
    /// Defects of NIST's library that a sound run avoided, limits that it passed.
    pub met: BTreeSet<Notice>,
    /// Warnings of results that are probably not what was meant, at their places in the program.
    pub warnings: Vec<Diagnostic>,
    /// The colour table, if the program has a section COLOR.
    pub colour: Option<ColourTable>,
}
