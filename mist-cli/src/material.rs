//! The material that a command was given: JSON, or the first step of a program.

use std::path::Path;

use mist_engine::{
    Failure,
    material::{MaterialError, PreparedMaterial},
    request::MaterialDescription,
};
use mist_runner::files::DiskFiles;
use rise_bridge::export::ExportError;
use scattering::Mode;

use super::{
    error::{CommandError, ExitStatus},
    flags::{CompatFlag, EngineFlags},
    input::InputText,
    program::ProgramInput,
    report::{self, MessageFormat},
    reporter::Reporter,
};

/// The material in `source`, which was read from `path`; its warnings go to `reporter`.
pub(super) fn prepared(
    path: &Path,
    source: &InputText,
    mode: Mode,
    reporter: &Reporter,
) -> Result<PreparedMaterial, CommandError> {
    let described = MaterialDescription::parse(&source.text);
    let described = described.map_err(|error| {
        CommandError::Refused(format!("{}: not a material: {error}", source.name()))
    })?;
    let program = match described {
        MaterialDescription::Program(program) => ProgramInput::new(source, program),
        model @ MaterialDescription::Model(_) => {
            let files = DiskFiles::beside(path).shared();
            return model.prepare(mode, Some(files)).map_err(refused);
        }
    };
    let told = |diagnostics: &[_]| {
        reporter.diagnostics(diagnostics, &program.source, MessageFormat::Human);
        CommandError::Reported(ExitStatus::Refused)
    };
    let flags = EngineFlags { compat: CompatFlag { compat: mode == Mode::Compat }, seed: None };
    let job = program.compile(&program.options(flags, None)).map_err(|found| told(&found))?;
    reporter.warn_of_program(&job.slips(), &program.source, MessageFormat::Human);
    PreparedMaterial::of_step(&job).map_err(|failure| match failure {
        Failure::Program(found) => told(&found),
        other => CommandError::Failed(other.to_string()),
    })
}

/// Error of reading a material.
pub(super) fn refused(error: MaterialError) -> CommandError {
    let message = report::with_help(&error.to_string(), error.help());
    match error {
        MaterialError::Limit(_) | MaterialError::Cancelled | MaterialError::NotFinite(_) => {
            CommandError::Failed(message)
        }
        _ => CommandError::Refused(message),
    }
}

/// Error of exporting a material.
pub(super) fn not_exported(error: ExportError) -> CommandError {
    match error {
        ExportError::Material(error) => refused(error),
        ExportError::Refused { .. } | ExportError::Tensor(_) => {
            CommandError::Refused(error.to_string())
        }
        ExportError::Io(_) | ExportError::Cancelled => CommandError::Failed(error.to_string()),
    }
}
