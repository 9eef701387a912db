//! Data files reach the engine through one trait; what was read is kept for the run.

use std::{
    collections::{BTreeMap, HashMap},
    sync::{Arc, Mutex},
};

use mist_format::{
    Dialect,
    suggestion::did_you_mean,
    table::{ColumnTable, ListTable, TableError},
};

/// Source of the texts of data files.
pub trait Files: Sync {
    /// The whole text of the file that a program calls `name`.
    ///
    /// # Errors
    ///
    /// If there is no such file, or it cannot be read.
    fn read(&self, name: &str) -> Result<Arc<str>, FileError>;

    /// Names of files that could have been meant, for a suggestion.
    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

/// A data file that cannot be had.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cannot open file {name:?}: {reason}")]
pub struct FileError {
    /// The name in the program.
    pub name: String,
    /// The reason.
    pub reason: String,
}

/// Files that are given with the program.
#[derive(Clone, Debug, Default)]
pub struct MemoryFiles(pub BTreeMap<String, Arc<str>>);

impl Files for MemoryFiles {
    fn read(&self, name: &str) -> Result<Arc<str>, FileError> {
        let found = self.0.get(name).cloned();
        found.ok_or_else(|| FileError {
            name: name.into(),
            reason: "not sent with the program".into(),
        })
    }

    fn names(&self) -> Vec<String> {
        self.0.keys().cloned().collect()
    }
}

/// The files that came with a text, then those around it.
pub(crate) struct LayeredFiles {
    own: MemoryFiles,
    around: Option<Arc<dyn Files + Send + Sync>>,
}

impl LayeredFiles {
    /// The files `own`, by name, and those that `around` has.
    pub(crate) fn new(
        own: &BTreeMap<String, String>,
        around: Option<Arc<dyn Files + Send + Sync>>,
    ) -> Self {
        let own = own.iter().map(|(name, text)| (name.clone(), text.as_str().into()));
        Self { own: MemoryFiles(own.collect()), around }
    }
}

impl Files for LayeredFiles {
    fn read(&self, name: &str) -> Result<Arc<str>, FileError> {
        match (&self.around, self.own.read(name)) {
            (Some(around), Err(_)) => around.read(name),
            (_, own) => own,
        }
    }

    fn names(&self) -> Vec<String> {
        let around = self.around.iter().flat_map(|around| around.names());
        self.own.names().into_iter().chain(around).collect()
    }
}

/// Data files of a run: each is read and parsed once. Clones share them.
#[derive(Clone)]
pub struct DataFiles {
    shelf: Arc<FileCache>,
}

struct FileCache {
    files: Arc<dyn Files + Send + Sync>,
    dialect: Dialect,
    texts: Mutex<HashMap<String, Result<Arc<str>, FileError>>>,
    tables: Mutex<HashMap<String, Result<Arc<ColumnTable>, TableError>>>,
}

impl DataFiles {
    /// A library that reads from `files`.
    pub fn new(files: Arc<dyn Files + Send + Sync>, dialect: Dialect) -> Self {
        let (texts, tables) = (Mutex::default(), Mutex::default());
        Self { shelf: Arc::new(FileCache { files, dialect, texts, tables }) }
    }

    /// Dialect in which files are read.
    pub fn dialect(&self) -> Dialect {
        self.shelf.dialect
    }

    /// The text of a file.
    ///
    /// # Errors
    ///
    /// If it cannot be had; with a suggestion if a name is similar.
    pub fn text(&self, name: &str) -> Result<Arc<str>, FileError> {
        let mut texts = self.shelf.texts.lock().expect("reading does not panic");
        let read = || {
            self.shelf.files.read(name).map_err(|mut error| {
                if let Some(other) =
                    did_you_mean(name, self.shelf.files.names().iter().map(String::as_str))
                {
                    error.reason = format!("{}; {other}", error.reason);
                }
                error
            })
        };
        texts.entry(name.to_owned()).or_insert_with(read).clone()
    }

    /// A file with columns of numbers.
    ///
    /// # Errors
    ///
    /// If it cannot be had, or holds no numbers.
    pub fn columns(&self, name: &str) -> Result<Arc<ColumnTable>, TableError> {
        if let Some(known) = self.shelf.tables.lock().expect("parsing does not panic").get(name) {
            return known.clone();
        }
        let table = self
            .text(name)
            .map_err(|error| TableError::Unreadable { file: name.into(), reason: error.reason })
            .and_then(|text| ColumnTable::parse(&text, self.shelf.dialect).map(Arc::new));
        let mut tables = self.shelf.tables.lock().expect("parsing does not panic");
        tables.insert(name.to_owned(), table.clone());
        table
    }

    /// A LIST file.
    ///
    /// # Errors
    ///
    /// Description of the error, in words.
    pub fn list(&self, name: &str) -> Result<Arc<ListTable>, String> {
        let text = self.text(name).map_err(|error| error.to_string())?;
        ListTable::parse(&text, self.shelf.dialect)
            .map(Arc::new)
            .map_err(|error| format!("{name}: {error}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_file_is_told_with_a_similar_name() {
        let files = MemoryFiles(BTreeMap::from([("gold.txt".to_owned(), Arc::from("1 2\n"))]));
        let library = DataFiles::new(Arc::new(files), Dialect::Sound);
        let error = library.text("glod.txt").unwrap_err();
        assert!(error.to_string().contains("gold.txt"), "{error}");
    }
}
