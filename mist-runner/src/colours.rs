//! Colour tables into files.

use std::{
    io,
    path::{Path, PathBuf},
};

use mist_engine::colour::ColourTable;
use rise_bridge::{
    formats::ColourFormat,
    write::{self, Style, WriteError},
};

use crate::files::{AtomicFile, WrittenFile};

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

/// Writes the files of `table` in the format of colour tables `format`; `path` is the name of the
/// first.
///
/// # Errors
///
/// If the format has no file for the table, or a file cannot be written.
pub fn save(
    format: ColourFormat,
    table: &ColourTable,
    path: &Path,
    style: Style,
) -> Result<Vec<WrittenFile>, SaveError> {
    let components = if format.writer.by_component { table.stokes } else { 1 };
    let save = |component| {
        let bytes = format.bytes(table, component, style)?;
        let path = PathBuf::from(write::component_name(&path.to_string_lossy(), component));
        match AtomicFile::write_bytes(&path, &bytes) {
            Ok(replaces) => Ok(WrittenFile { title: format.title, path, replaces }),
            Err(source) => Err(SaveError::Disk { path, source }),
        }
    };
    (0..components).map(save).collect()
}
