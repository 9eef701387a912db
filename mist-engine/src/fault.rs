//! Reasons for the end of a job: a wrong program, a failed run, a cancellation.

use std::io;

use mist_format::{Diagnostic, program::SourceText};

/// One thing that is wrong with a program at a known place.
pub type Fault = Box<Diagnostic>;

/// Reason why a run ended without its tables.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The program is wrong; it would fail on every machine in its first step.
    #[error("{}", first(.0))]
    Program(Vec<Diagnostic>),
    /// A later step of the program failed.
    #[error("step {step}: {fault}")]
    Step {
        /// Number of the step, from 0.
        step: u64,
        /// The fault.
        fault: Fault,
    },
    /// A limit was reached.
    #[error("{0}")]
    Limit(String),
    /// The run was stopped from outside.
    #[error("the run was cancelled")]
    Cancelled,
    /// The tables could not be written.
    #[error("the tables cannot be written: {0}")]
    Write(#[from] io::Error),
}

fn first(diagnostics: &[Diagnostic]) -> String {
    diagnostics.first().map_or_else(String::new, ToString::to_string)
}

/// A diagnostic about a part of `text`, moved to its place in the program.
pub(crate) fn placed(text: &SourceText, mut diagnostic: Diagnostic) -> Fault {
    diagnostic.span = text.locate(diagnostic.span);
    for note in &mut diagnostic.notes {
        note.span = note.span.map(|span| text.locate(span));
    }
    Box::new(diagnostic)
}

/// A diagnostic about the whole of `text`.
pub(crate) fn fault(code: &'static str, text: &SourceText, message: impl Into<String>) -> Fault {
    Box::new(Diagnostic::error(code, text.span(), message))
}

/// A fault of the first step is a fault of the program; a later one ends the run.
pub(crate) fn at_step(step: u64, fault: Fault) -> Failure {
    if step == 0 { Failure::Program(vec![*fault]) } else { Failure::Step { step, fault } }
}
