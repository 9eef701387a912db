//! Colour tables into files.

use std::{
    io,
    path::{Path, PathBuf},
};

use mist_engine::colour::ColourTable;
use rise_bridge::{
    formats::ColourWriter,
    write::{self, Style, WriteError},
};

use crate::files::AtomicFile;

/// Error of [`save`].
#[derive(Debug, thiserror::Error)]
pub enum SaveError {
    /// The table has no such text.
    #[error(transparent)]
    Text(#[from] WriteError),
    /// The text cannot be written.
    #[error("cannot write {path}: {source}", path = .path.display())]
    Disk {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
}

/// Writes the files of `table` in one format and gives their names; `path` is the name of the
/// first.
///
/// # Errors
///
/// If the format has no text for the table, or a file cannot be written.
pub fn save(
    writer: ColourWriter,
    table: &ColourTable,
    path: &Path,
    style: Style,
) -> Result<Vec<PathBuf>, SaveError> {
    let components = if writer.by_component { table.stokes } else { 1 };
    let save = |component| {
        let text = (writer.text)(table, component, style)?;
        let path = PathBuf::from(write::component_name(&path.to_string_lossy(), component));
        match AtomicFile::write(&path, &text) {
            Ok(()) => Ok(path),
            Err(source) => Err(SaveError::Disk { path, source }),
        }
    };
    (0..components).map(save).collect()
}
