//! Errors of commands, and the exit codes of the process.

use std::process::ExitCode;

use mist_engine::request::RequestError;

use super::report;

/// Error of a command: the reason why it has no result.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum CommandError {
    /// The arguments or the input are wrong.
    Refused(String),
    /// The arguments are right, but the work failed.
    Failed(String),
    /// The message was printed already; only the exit code is left.
    Reported(ExitStatus),
}

impl From<RequestError> for CommandError {
    fn from(error: RequestError) -> Self {
        Self::Refused(error.to_string())
    }
}

/// End of a piece of work; the worst of several decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum ExitStatus {
    /// It has a result.
    Success,
    /// The work failed.
    Failed,
    /// The program or the arguments are wrong.
    Refused,
    /// The user stopped it.
    Interrupted,
}

impl ExitStatus {
    /// `Ok` for success.
    pub(super) fn into_result(self) -> Result<(), CommandError> {
        if self == Self::Success { Ok(()) } else { Err(CommandError::Reported(self)) }
    }

    fn code(self) -> ExitCode {
        match self {
            Self::Success => ExitCode::SUCCESS,
            Self::Failed => ExitCode::from(1),
            Self::Refused => ExitCode::from(2),
            // That of a shell for Ctrl-C.
            Self::Interrupted => ExitCode::from(130),
        }
    }
}

impl CommandError {
    /// Prints the message and gives the exit code.
    pub(super) fn exit(self) -> ExitCode {
        let (message, status) = match self {
            Self::Refused(message) => (message, ExitStatus::Refused),
            Self::Failed(message) => (message, ExitStatus::Failed),
            Self::Reported(status) => return status.code(),
        };
        report::print_line(&format!("error: {message}"));
        status.code()
    }
}
