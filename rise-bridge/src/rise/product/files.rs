//! The files of a ring program, with a record of those that were read.

use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use mist_engine::{FileError, Files, MemoryFiles};

use crate::rise::{material::SceneMaterial, program::RingProgram};

/// The files of a program: its lists, generated files, and the files beside the scene, which are
/// recorded when they are read.
pub(super) struct RecordedFiles {
    own: MemoryFiles,
    beside: Arc<dyn Files + Send + Sync>,
    recorded: Mutex<BTreeMap<String, Arc<str>>>,
}

impl RecordedFiles {
    /// The files of `written` for `material`; `beside` are the files beside the scene.
    pub(super) fn new(
        material: &SceneMaterial,
        written: &RingProgram,
        beside: Arc<dyn Files + Send + Sync>,
    ) -> Self {
        let made = material.material.files.iter().chain([(&written.rings.0, &written.rings.1)]);
        let own = made.chain([(&written.waves.0, &written.waves.1)]);
        let own = own.map(|(name, text)| (name.clone(), text.as_str().into())).collect();
        let made = &material.material.files;
        let recorded =
            made.iter().map(|(name, text)| (name.clone(), text.as_str().into())).collect();
        Self { own: MemoryFiles(own), beside, recorded: Mutex::new(recorded) }
    }
}

impl RecordedFiles {
    /// The generated and the recorded files, by name.
    pub(super) fn read_files(&self) -> BTreeMap<String, Arc<str>> {
        self.lock().clone()
    }

    /// A map of texts is valid after every step, so a poisoned lock is usable.
    fn lock(&self) -> MutexGuard<'_, BTreeMap<String, Arc<str>>> {
        self.recorded.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Files for RecordedFiles {
    fn read(&self, name: &str) -> Result<Arc<str>, FileError> {
        if let Ok(text) = self.own.read(name) {
            return Ok(text);
        }
        let text = self.beside.read(name)?;
        // Files in other folders are not copied.
        if !name.contains(['/', '\\']) {
            self.lock().insert(name.to_owned(), text.clone());
        }
        Ok(text)
    }

    fn names(&self) -> Vec<String> {
        [self.own.names(), self.beside.names()].concat()
    }
}
