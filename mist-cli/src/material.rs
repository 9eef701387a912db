//! The material that a command was given: JSON, or the first step of a program.

use std::path::Path;

use mist_engine::{
    Failure, Options, compile,
    material::{Material, MaterialError, Prepared},
};
use mist_runner::files::DiskFiles;
use rise_bridge::export::ExportError;

use super::{
    run::mode,
    source::Source,
    stop::{Fate, Stop},
};
use crate::report::{self, MessageFormat};

/// The material in `source`, which was read from `path`.
pub(super) fn prepared(path: &Path, source: &Source, compat: bool) -> Result<Prepared, Stop> {
    let files = DiskFiles::beside(path).shared();
    if source.text.trim_start().starts_with('{') {
        let material = Material::from_json(&source.text).map_err(refused)?;
        return material.prepare(mode(compat), Some(files)).map_err(refused);
    }
    let options = Options { mode: mode(compat), job: source.stem(), ..Options::default() };
    let told = |diagnostics: &[_]| {
        report::tell(diagnostics, &source.name(), &source.text, MessageFormat::Human);
        Stop::Said(Fate::Refused)
    };
    let job = compile(&source.text, files, &options).map_err(|found| told(&found))?;
    Prepared::of_step(&job).map_err(|failure| match failure {
        Failure::Program(found) => told(&found),
        other => Stop::Failed(other.to_string()),
    })
}

/// Why a material cannot be had.
pub(super) fn refused(error: MaterialError) -> Stop {
    let message = report::with_help(&error.to_string(), error.help());
    match error {
        MaterialError::Limit(_) | MaterialError::Cancelled | MaterialError::NotFinite(_) => {
            Stop::Failed(message)
        }
        _ => Stop::Refused(message),
    }
}

/// Why a material cannot be exported.
pub(super) fn not_exported(error: ExportError) -> Stop {
    match error {
        ExportError::Material(error) => refused(error),
        ExportError::Refused { .. } | ExportError::Tensor(_) => Stop::Refused(error.to_string()),
        ExportError::Io(_) | ExportError::Cancelled => Stop::Failed(error.to_string()),
    }
}
