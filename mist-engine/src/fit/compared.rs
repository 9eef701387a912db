//! Measured values beside the computed ones at given values of the variables.

use super::{error::FitError, measured::MeasuredTable};
use crate::{Control, function::ProgramFunction};

/// A measured value and the computed one.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedValue {
    /// The columns of the loops.
    pub loops: Vec<String>,
    /// Output of the program.
    pub output: usize,
    /// The measured value.
    pub measured: f64,
    /// The computed value.
    pub computed: f64,
}

/// All values of `measured` beside those that `program` gives at the variables `values`.
///
/// # Errors
///
/// If the program cannot be run there, or its lines are not those of the table.
pub fn compared(
    program: &ProgramFunction,
    measured: &MeasuredTable,
    values: &[f64],
    control: &Control,
) -> Result<Vec<ComparedValue>, FitError> {
    let run = program
        .run(values, control)
        .map_err(|failure| FitError::Run { values: Vec::new(), failure })?;
    let lines = measured.locate(&run.rows, &program.titles()[0])?;
    let value = |(datum, line): (&super::Datum, usize)| ComparedValue {
        loops: run.rows[line].loops.clone(),
        output: datum.output,
        measured: datum.value,
        computed: run.rows[line].outputs[datum.output],
    };
    Ok(measured.data().iter().zip(lines).map(value).collect())
}
