//! The text of a program or a material that a command was given.

use std::{
    fs::File,
    io::Read,
    path::{Path, PathBuf},
};

use mist_format::program::MAX_PROGRAM_BYTES;
use mist_runner::files::decode;

use super::error::CommandError;

/// A text and where it came from.
pub(super) struct InputText {
    /// Its file, as it was given.
    pub(super) path: PathBuf,
    /// Its text.
    pub(super) text: String,
}

impl InputText {
    /// Reads the file at `path`.
    pub(super) fn read(path: &Path) -> Result<Self, CommandError> {
        Self::of(path, u64::MAX)
    }

    /// Reads the program at `path`: JSON whole, a text up to a byte more than a program may have,
    /// so that compiling refuses a longer one.
    pub(super) fn program(path: &Path) -> Result<Self, CommandError> {
        let text = Self::of(path, MAX_PROGRAM_BYTES as u64 + 1)?;
        let is_long_json =
            text.text.len() > MAX_PROGRAM_BYTES && text.text.trim_start().starts_with('{');
        if is_long_json { Self::read(path) } else { Ok(text) }
    }

    fn of(path: &Path, most: u64) -> Result<Self, CommandError> {
        let mut bytes = Vec::new();
        match File::open(path).and_then(|file| file.take(most).read_to_end(&mut bytes)) {
            Ok(_) => Ok(Self { path: path.to_owned(), text: decode(bytes) }),
            Err(error) => {
                Err(CommandError::Refused(format!("cannot read {}: {error}", path.display())))
            }
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
pub(super) fn read_input(path: Option<&Path>) -> Result<String, CommandError> {
    if let Some(path) = path {
        return InputText::read(path).map(|source| source.text);
    }
    let mut bytes = Vec::new();
    match std::io::stdin().lock().read_to_end(&mut bytes) {
        Ok(_) => Ok(decode(bytes)),
        Err(error) => Err(CommandError::Refused(format!("cannot read standard input: {error}"))),
    }
}
