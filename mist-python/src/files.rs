//! Data files that are given or found on the disk, with a record of those that were read.

use std::{
    collections::BTreeMap,
    path::Path,
    sync::{Arc, Mutex},
};

use mist_engine::{FileError, Files};
use mist_runner::files::DiskFiles;

use crate::kept::locked;

/// Data files that were given and those on the disk, with a record of which were read.
pub(crate) struct RecordedFiles {
    given: BTreeMap<String, String>,
    disk: DiskFiles,
    read: Mutex<BTreeMap<String, Arc<str>>>,
}

impl RecordedFiles {
    /// Texts by name, then the files of the working folder and along `SCATMECH`.
    pub(crate) fn new(given: BTreeMap<String, String>) -> Self {
        Self::beside(given, Path::new(""))
    }

    /// Texts by name, then the files of the working folder, beside the program at `path` and along
    /// `SCATMECH`.
    pub(crate) fn beside(given: BTreeMap<String, String>, path: &Path) -> Self {
        Self { given, disk: DiskFiles::beside(path), read: Mutex::default() }
    }

    /// Names and texts of the files that were read.
    pub(crate) fn read(&self) -> BTreeMap<String, Arc<str>> {
        locked(&self.read).clone()
    }
}

impl Files for RecordedFiles {
    fn read(&self, name: &str) -> Result<Arc<str>, FileError> {
        let text = match self.given.get(name) {
            Some(text) => text.as_str().into(),
            None => self.disk.read(name)?,
        };
        locked(&self.read).insert(name.to_owned(), Arc::clone(&text));
        Ok(text)
    }

    fn names(&self) -> Vec<String> {
        self.given.keys().cloned().chain(self.disk.names()).collect()
    }
}
