//! How a command ends when it does not end well.

use std::process::ExitCode;

use crate::report;

/// Why a command ends without its result.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Stop {
    /// The arguments or the input are wrong.
    Refused(String),
    /// They are right, but the work failed.
    Failed(String),
    /// What there is to say was said; only the code is left.
    Said(Fate),
}

/// How a piece of work ended; the worst of several decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Fate {
    /// With its result.
    Good,
    /// The run failed.
    Failed,
    /// The program or the arguments are wrong.
    Refused,
}

impl Fate {
    /// `Ok` if it was good.
    pub(super) fn done(self) -> Result<(), Stop> {
        if self == Self::Good { Ok(()) } else { Err(Stop::Said(self)) }
    }

    fn code(self) -> ExitCode {
        match self {
            Self::Good => ExitCode::SUCCESS,
            Self::Failed => ExitCode::from(1),
            Self::Refused => ExitCode::from(2),
        }
    }
}

impl Stop {
    /// Says why, and gives the exit code.
    pub(super) fn exit(self) -> ExitCode {
        let (message, fate) = match self {
            Self::Refused(message) => (message, Fate::Refused),
            Self::Failed(message) => (message, Fate::Failed),
            Self::Said(fate) => return fate.code(),
        };
        report::say(&format!("error: {message}"));
        fate.code()
    }
}
