//! Finished steps of a run, from which an interrupted run continues.
//!
//! A step is kept as the values of its integrals: all that a replay cannot compute without the
//! model. With them the texts, the spectra and the variables that are fed back come out again, to
//! the last bit.

use std::io;

use smallvec::SmallVec;

use crate::step::Evaluated;

/// Result of the evaluation of one step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StepResult {
    /// The integrals, in the order of the program.
    pub values: SmallVec<[Evaluated; 4]>,
    /// The lines of the samples file, if the program has one.
    pub samples: String,
}

/// Keeps the steps of a run outside of the engine.
pub trait Journal: Send {
    /// Result of `step` that an earlier run of the same job stored; steps are requested in order.
    ///
    /// # Errors
    ///
    /// If it cannot be read.
    fn recall(&mut self, step: u64) -> io::Result<Option<StepResult>>;

    /// Keeps the steps from `first` on.
    ///
    /// # Errors
    ///
    /// If they cannot be kept; the run ends.
    fn keep(&mut self, first: u64, steps: &[StepResult]) -> io::Result<()>;
}

/// Remembers nothing.
pub(crate) struct NoJournal;

impl Journal for NoJournal {
    fn recall(&mut self, _: u64) -> io::Result<Option<StepResult>> {
        Ok(None)
    }

    fn keep(&mut self, _: u64, _: &[StepResult]) -> io::Result<()> {
        Ok(())
    }
}
