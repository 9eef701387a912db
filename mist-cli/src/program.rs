//! The program that a command was given: a text, or JSON with data files.

use std::{path::Path, sync::Arc};

use mist_engine::{Files, Job, Limits, Options, request::ProgramDescription};
use mist_format::Diagnostic;
use mist_runner::files::DiskFiles;
use scattering::Mode;

use super::{error::CommandError, flags::EngineFlags, input::InputText};

/// A program, the files that came with it, and where it came from.
pub(super) struct ProgramInput {
    /// The text of the program; places of messages are places in it.
    pub(super) source: InputText,
    description: ProgramDescription,
}

impl ProgramInput {
    /// Reads the file at `path`: the text of a program, or `{"program": …, "files": {…}}`.
    pub(super) fn read(path: &Path) -> Result<Self, CommandError> {
        let source = InputText::program(path)?;
        let description = ProgramDescription::parse(&source.text).map_err(|error| {
            let problem = format!("{}: not a program with its files: {error}", source.name());
            CommandError::Refused(problem)
        })?;
        Ok(Self::new(&source, description))
    }

    /// The program of a `description` that was read from `source`.
    pub(super) fn new(source: &InputText, description: ProgramDescription) -> Self {
        let (path, text) = (source.path.clone(), description.program.clone());
        Self { source: InputText { path, text }, description }
    }

    /// The options of a run; those of the command line come before those of the description.
    pub(super) fn options(&self, flags: EngineFlags, job: Option<&str>) -> Options {
        let own = self.description.options(&self.source.stem(), Limits::default());
        Options {
            mode: if flags.compat.compat { Mode::Compat } else { own.mode },
            job: job.map_or(own.job, str::to_owned),
            seed: flags.seed.unwrap_or(own.seed),
            limits: own.limits,
        }
    }

    /// The files of the description, then those beside the program.
    pub(super) fn files(&self) -> Arc<dyn Files + Send + Sync> {
        self.description.files_before(Some(DiskFiles::beside(&self.source.path).shared()))
    }

    /// Compiles the program.
    pub(super) fn compile(&self, options: &Options) -> Result<Job, Vec<Diagnostic>> {
        mist_engine::compile(&self.source.text, self.files(), options)
    }
}
