//! The text of a program or a material that a command was given.

use std::{
    fs,
    io::Read,
    path::{Path, PathBuf},
};

use super::Stop;
use crate::disk::decode;

/// A text and where it came from.
pub(super) struct Source {
    /// Its file, as it was given.
    pub(super) path: PathBuf,
    /// Its text.
    pub(super) text: String,
}

impl Source {
    /// Reads the file at `path`.
    pub(super) fn read(path: &Path) -> Result<Self, Stop> {
        match fs::read(path) {
            Ok(bytes) => Ok(Self { path: path.to_owned(), text: decode(bytes) }),
            Err(error) => Err(Stop::Refused(format!("cannot read {}: {error}", path.display()))),
        }
    }

    /// The file's name for messages.
    pub(super) fn name(&self) -> String {
        self.path.display().to_string()
    }

    /// The file's name without folder and extension.
    pub(super) fn stem(&self) -> String {
        let stem = self.path.file_stem().unwrap_or(self.path.as_os_str());
        stem.to_string_lossy().into_owned()
    }
}

/// Standard input, or the file at `path`.
pub(super) fn read_input(path: Option<&Path>) -> Result<String, Stop> {
    if let Some(path) = path {
        return Source::read(path).map(|source| source.text);
    }
    let mut bytes = Vec::new();
    match std::io::stdin().lock().read_to_end(&mut bytes) {
        Ok(_) => Ok(decode(bytes)),
        Err(error) => Err(Stop::Refused(format!("cannot read standard input: {error}"))),
    }
}
