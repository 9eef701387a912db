//! Programs of clients, compiled within limits; they see no files but their own.

use mist_engine::{Failure, Job, Limits, request::ProgramDescription};
use mist_format::program::count_tokens;

use crate::{
    failure::FailureReport,
    limits::{LimitReached, ServeLimits},
    output::OutputTooLong,
};

/// The reason why a program has no result.
#[derive(Clone, Debug)]
pub(crate) enum ProgramError {
    /// The program is longer than a limit of the service.
    TooLarge(LimitReached),
    /// The program is wrong, or fails in a step.
    Wrong(Box<FailureReport>),
    /// A limit of the engine was reached.
    Limit(String),
    /// The output is longer than a limit of the service.
    OutputTooLong(LimitReached),
    /// The run was cancelled.
    Cancelled(String),
    /// The output or the steps cannot be stored.
    Storage(String),
}

impl ProgramError {
    /// The failure of the program `text`.
    pub(crate) fn of(text: &str, failure: Failure) -> Self {
        let message = failure.to_string();
        let wrong = |found: &[_]| Self::Wrong(Box::new(FailureReport::of_diagnostics(text, found)));
        match failure {
            Failure::Program(found) => wrong(&found),
            Failure::Step { step, fault } => wrong(&[fault.note(format!("in step {}", step + 1))]),
            Failure::Limit(message) => Self::Limit(message),
            Failure::Cancelled => Self::Cancelled(message),
            Failure::Write(error) => match error.downcast::<OutputTooLong>() {
                Ok(OutputTooLong(limit)) => Self::OutputTooLong(limit),
                Err(error) => Self::Storage(format!("the results cannot be kept: {error}")),
            },
        }
    }

    /// The report for clients.
    pub(crate) fn report(self) -> FailureReport {
        match self {
            Self::TooLarge(limit) => FailureReport::of_limit("too-large", limit),
            Self::Wrong(report) => *report,
            Self::Limit(message) => FailureReport::new("limit", message),
            Self::OutputTooLong(limit) => FailureReport::of_limit("limit", limit),
            Self::Cancelled(message) | Self::Storage(message) => {
                FailureReport::new("unavailable", message)
            }
        }
    }
}

/// Refuses a program that is too long.
pub(crate) fn admit(
    program: &ProgramDescription,
    limits: &ServeLimits,
) -> Result<(), ProgramError> {
    let (bytes, tokens) = (program.program.len(), count_tokens(&program.program));
    for (count, most, what, flag) in [
        (bytes, limits.max_program, "bytes", "max-program"),
        (tokens, limits.max_tokens, "tokens", "max-tokens"),
    ] {
        if count > most {
            let message = format!("the program has {count} {what}, more than {most}");
            let limit = LimitReached { flag, value: most as f64, message };
            return Err(ProgramError::TooLarge(limit));
        }
    }
    Ok(())
}

/// Compiles a program within `limits`.
pub(crate) fn compiled(program: &ProgramDescription, limits: Limits) -> Result<Job, ProgramError> {
    program
        .compile(&program.options("job", limits), None)
        .map_err(|found| ProgramError::of(&program.program, Failure::Program(found)))
}
