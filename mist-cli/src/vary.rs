//! What commands have in common that run a program with other values of its variables.

use std::path::PathBuf;

use mist_engine::{
    Control, Options,
    function::{FunctionError, ProgramFunction},
};
use mist_format::Diagnostic;
use mist_runner::files::DiskFiles;

use super::{
    run::mode,
    source::Source,
    stop::{Fate, Stop},
    watch::watched,
};
use crate::report::{self, MessageFormat};

/// A program and the variables that change.
#[derive(clap::Args)]
pub(super) struct Vary {
    /// The program.
    pub(super) program: PathBuf,
    /// Names of variables in VARIABLES; parameters of the model with or without their #.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', required = true)]
    vary: Vec<String>,
    /// Compute as NIST does, defects included.
    #[arg(long)]
    compat: bool,
    /// Threads [default: one per processor]; results do not depend on it.
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Seed of the Monte Carlo modes.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print JSON.
    #[arg(long)]
    pub(super) json: bool,
}

impl Vary {
    /// The program of `source` as a function of its variables.
    pub(super) fn open(&self, source: &Source) -> Result<ProgramFunction, Stop> {
        let files = DiskFiles::beside(&self.program).shared();
        let mode = mode(self.compat);
        let options = Options { mode, job: source.stem(), seed: self.seed, ..Options::default() };
        let names: Vec<String> = self.vary.iter().map(|name| name.trim().to_owned()).collect();
        ProgramFunction::new(&source.text, files, options, &names).map_err(|error| match error {
            FunctionError::Program(diagnostics) => {
                tell(&diagnostics, source);
                Stop::Said(Fate::Refused)
            }
            other => Stop::Refused(format!("{}: {other}", source.name())),
        })
    }

    /// Does `work` on the threads that were asked for, with a bar called `label`.
    pub(super) fn watch<T: Send>(
        &self,
        label: &str,
        work: impl FnOnce(&Control) -> T + Send,
    ) -> Result<T, Stop> {
        watched(self.threads, label, work)
    }
}

/// Tells what is wrong with the program.
pub(super) fn tell(diagnostics: &[Diagnostic], source: &Source) {
    report::tell(diagnostics, &source.name(), &source.text, MessageFormat::Human);
}

/// A result as a line of JSON.
pub(super) fn json(found: &impl serde::Serialize) -> Result<String, Stop> {
    serde_json::to_string(found)
        .map(|text| text + "\n")
        .map_err(|error| Stop::Failed(format!("the result has no JSON form: {error}")))
}
