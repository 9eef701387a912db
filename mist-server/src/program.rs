//! Programs of clients: a text with its data files, compiled within limits.

use std::{collections::BTreeMap, sync::Arc};

use mist_engine::{Failure, Files, Job, Limits, MemoryFiles, Options, compile};
use mist_format::program::count_tokens;
use scattering::Mode;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::{
    failure::FailureReport,
    limits::{LimitReached, ServeLimits},
    output::OutputTooLong,
};

/// A program with its data files; it sees no others.
#[derive(Clone, Debug, Default, Deserialize, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = ProgramBody)]
pub(crate) struct ProgramRequest {
    /// The text of the program.
    pub(crate) program: String,
    /// Texts of data files by the names that the program gives them.
    #[serde(default)]
    pub(crate) files: BTreeMap<String, String>,
    /// Give NIST's tables, its defects included.
    #[serde(default)]
    pub(crate) compat: bool,
    /// Name of the job.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) job: Option<String>,
    /// Seed of the Monte Carlo modes; 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) seed: Option<u64>,
}

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

impl ProgramRequest {
    /// A program that needs no files.
    pub(crate) fn bare(program: String) -> Self {
        Self { program, ..Self::default() }
    }

    /// Refuses a program that is too long.
    pub(crate) fn admit(&self, limits: &ServeLimits) -> Result<(), ProgramError> {
        let (bytes, tokens) = (self.program.len(), count_tokens(&self.program));
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

    /// The files that were sent.
    pub(crate) fn files(&self) -> Arc<dyn Files + Send + Sync> {
        let each = |(name, text): (&String, &String)| (name.clone(), text.as_str().into());
        Arc::new(MemoryFiles(self.files.iter().map(each).collect()))
    }

    /// The options with which the program is compiled and run.
    pub(crate) fn options(&self, limits: Limits) -> Options {
        Options {
            mode: if self.compat { Mode::Compat } else { Mode::Sound },
            job: self.job.clone().unwrap_or_else(|| "job".into()),
            seed: self.seed.unwrap_or(1),
            limits,
        }
    }

    /// Compiles the program within `limits`.
    pub(crate) fn compile(&self, limits: Limits) -> Result<Job, ProgramError> {
        compile(&self.program, self.files(), &self.options(limits))
            .map_err(|found| ProgramError::of(&self.program, Failure::Program(found)))
    }
}
