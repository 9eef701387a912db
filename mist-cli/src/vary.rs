//! Arguments of commands that run a program with other values of its variables.

use std::path::PathBuf;

use mist_engine::{
    Control, Warning,
    function::{FunctionError, ProgramFunction},
};
use mist_format::Diagnostic;

use super::{
    error::{CommandError, ExitStatus},
    flags::{EngineFlags, JsonFlag},
    input::InputText,
    program::ProgramInput,
    report::MessageFormat,
    reporter::Reporter,
    threads::ThreadsFlag,
};

/// A program and the variables that change.
#[derive(clap::Args)]
pub(super) struct VaryArgs {
    /// The program.
    pub(super) program: PathBuf,
    /// Names of variables in VARIABLES; parameters of the model with or without their #.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', required = true)]
    vary: Vec<String>,
    #[command(flatten)]
    engine: EngineFlags,
    #[command(flatten)]
    threads: ThreadsFlag,
    #[command(flatten)]
    pub(super) json: JsonFlag,
}

impl VaryArgs {
    /// The `program` as a function of its variables.
    ///
    /// Its warnings go to `reporter`, and stop the command if they are denied.
    pub(super) fn open(
        &self,
        program: &ProgramInput,
        reporter: &Reporter,
    ) -> Result<ProgramFunction, CommandError> {
        let source = &program.source;
        let options = program.options(self.engine, None);
        let names: Vec<String> = self.vary.iter().map(|name| name.trim().to_owned()).collect();
        let function = ProgramFunction::new(&source.text, program.files(), options, &names);
        let function = function.map_err(|error| match error {
            FunctionError::Program(diagnostics) => {
                tell(&diagnostics, source, reporter);
                CommandError::Reported(ExitStatus::Refused)
            }
            other => CommandError::Refused(format!("{}: {other}", source.name())),
        })?;
        reporter.warn_of_program(&function.slips(), source, MessageFormat::Human);
        reporter.check()?;
        Ok(function)
    }

    /// Does `work` on the threads that were asked for, with a bar called `label`.
    pub(super) fn watch<T: Send>(
        &self,
        label: &str,
        work: impl FnOnce(&Control) -> T + Send,
    ) -> Result<T, CommandError> {
        self.threads.run(label, work)
    }
}

/// Tells what is wrong with the program.
pub(super) fn tell(diagnostics: &[Diagnostic], source: &InputText, reporter: &Reporter) {
    reporter.diagnostics(diagnostics, source, MessageFormat::Human);
}

/// A result with its warnings.
#[derive(serde::Serialize)]
struct WithWarnings<'a, T> {
    #[serde(flatten)]
    found: &'a T,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    warnings: &'a [Warning],
}

/// A result as a line of JSON, with the key `warnings` if there are any.
pub(super) fn json(
    found: &impl serde::Serialize,
    warnings: &[Warning],
) -> Result<String, CommandError> {
    serde_json::to_string(&WithWarnings { found, warnings })
        .map(|text| text + "\n")
        .map_err(|error| CommandError::Failed(format!("the result has no JSON form: {error}")))
}
