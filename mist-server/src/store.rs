//! The store of materials and jobs: one file that outlives the service, or memory.
//!
//! Every change is one transaction: after a crash the file has what was there before it or what
//! was there after it.

use std::{
    fmt, io,
    path::{Path, PathBuf},
    sync::{Arc, PoisonError, RwLock},
};

use redb::{
    Database, DatabaseError, ReadableDatabase, ReadableTable, StorageError, TableDefinition,
    WriteTransaction, backends::InMemoryBackend,
};

/// Name of the file in the folder of the service.
const FILE: &str = "mist.redb";

/// Bodies of materials by name.
const MATERIALS: TableDefinition<'_, &str, &str> = TableDefinition::new("materials");
/// Records of jobs, JSON, by id.
const JOBS: TableDefinition<'_, &str, &str> = TableDefinition::new("jobs");
/// Programs of jobs with their files, JSON, by id.
const PROGRAMS: TableDefinition<'_, &str, &str> = TableDefinition::new("programs");
/// Finished steps by job and number.
const STEPS: TableDefinition<'_, (&str, u64), &[u8]> = TableDefinition::new("steps");
/// Texts of finished jobs by job and kind.
const TEXTS: TableDefinition<'_, (&str, &str), &str> = TableDefinition::new("texts");

type Open = dyn Fn() -> Result<Database, DatabaseError> + Send + Sync;

/// Stored materials and jobs.
#[derive(Clone)]
pub(crate) struct Store {
    /// `None` after a failure, until it is opened again.
    database: Arc<RwLock<Option<Database>>>,
    open: Arc<Open>,
}

impl fmt::Debug for Store {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Store")
    }
}

/// The reason why the store cannot be used.
#[derive(Debug, thiserror::Error)]
pub(crate) enum StoreError {
    /// It cannot be read or written.
    #[error("the store cannot be read or written: {0}")]
    Database(Box<redb::Error>),
    /// Another service has its file open.
    #[error(
        "the store {path} is open in another service: stop that one, or give another --data",
        path = .0.display()
    )]
    InUse(PathBuf),
    /// Its file cannot be opened.
    #[error(
        "the store {path} cannot be opened: {source}; if it is no store of this version, move it \
         away, and the service starts with an empty one",
        path = .path.display()
    )]
    Unusable {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: Box<redb::Error>,
    },
}

impl<E: Into<redb::Error>> From<E> for StoreError {
    fn from(error: E) -> Self {
        Self::Database(Box::new(error.into()))
    }
}

impl From<StoreError> for io::Error {
    fn from(error: StoreError) -> Self {
        Self::other(error)
    }
}

impl StoreError {
    /// True if the database must be opened again before it can be used.
    fn is_final(&self) -> bool {
        use redb::Error::{DatabaseClosed, Io, LockPoisoned, PreviousIo};
        let Self::Database(error) = self else { return false };
        matches!(**error, Io(_) | PreviousIo | DatabaseClosed | LockPoisoned(_))
    }

    /// The same error of the first use of the file at `path`, with a remedy.
    fn of_opening(self, path: &Path) -> Self {
        match self {
            Self::Database(error) if matches!(*error, redb::Error::DatabaseAlreadyOpen) => {
                Self::InUse(path.to_owned())
            }
            Self::Database(source) => Self::Unusable { path: path.to_owned(), source },
            other => other,
        }
    }
}

impl Store {
    /// In the folder `folder`, which is made if it is not there; else in memory.
    ///
    /// # Errors
    ///
    /// If the file cannot be opened, or another service has it open.
    pub(crate) fn new(folder: Option<&Path>) -> Result<Self, StoreError> {
        match folder {
            None => Self::on(|| Database::builder().create_with_backend(InMemoryBackend::new())),
            Some(folder) => {
                std::fs::create_dir_all(folder).map_err(StorageError::Io)?;
                let path = folder.join(FILE);
                let file = path.clone();
                Self::on(move || Database::create(&file)).map_err(|error| error.of_opening(&path))
            }
        }
    }

    fn on(
        open: impl Fn() -> Result<Database, DatabaseError> + Send + Sync + 'static,
    ) -> Result<Self, StoreError> {
        let store = Self { database: Arc::default(), open: Arc::new(open) };
        // Reading needs the tables to be there.
        store.write(|change| {
            change.open_table(MATERIALS)?;
            change.open_table(JOBS)?;
            change.open_table(PROGRAMS)?;
            change.open_table(STEPS)?;
            change.open_table(TEXTS)?;
            Ok(())
        })?;
        Ok(store)
    }

    /// Every material: name and body.
    pub(crate) fn materials(&self) -> Result<Vec<(String, String)>, StoreError> {
        self.pairs(MATERIALS)
    }

    /// Stores the body of a material.
    pub(crate) fn put_material(&self, name: &str, body: &str) -> Result<(), StoreError> {
        self.write(|change| {
            change.open_table(MATERIALS)?.insert(name, body)?;
            Ok(())
        })
    }

    /// Removes a material.
    pub(crate) fn remove_material(&self, name: &str) -> Result<(), StoreError> {
        self.write(|change| {
            change.open_table(MATERIALS)?.remove(name)?;
            Ok(())
        })
    }

    /// Every job: id and record.
    pub(crate) fn jobs(&self) -> Result<Vec<(String, String)>, StoreError> {
        self.pairs(JOBS)
    }

    /// Stores the record and the program of a new job.
    pub(crate) fn put_job(&self, id: &str, record: &str, program: &str) -> Result<(), StoreError> {
        self.write(|change| {
            change.open_table(JOBS)?.insert(id, record)?;
            change.open_table(PROGRAMS)?.insert(id, program)?;
            Ok(())
        })
    }

    /// The program of a job.
    pub(crate) fn program(&self, id: &str) -> Result<Option<String>, StoreError> {
        self.with(|database| {
            let programs = database.begin_read()?.open_table(PROGRAMS)?;
            Ok(programs.get(id)?.map(|text| text.value().to_owned()))
        })
    }

    /// Stores the record and the texts of a job that is over; its steps are not needed any more.
    pub(crate) fn finish_job(
        &self,
        id: &str,
        record: &str,
        texts: &[(String, String)],
    ) -> Result<(), StoreError> {
        self.write(|change| {
            change.open_table(JOBS)?.insert(id, record)?;
            let mut table = change.open_table(TEXTS)?;
            for (kind, text) in texts {
                table.insert((id, kind.as_str()), text.as_str())?;
            }
            remove_steps(change, id)
        })
    }

    /// Removes a job with all that belongs to it.
    pub(crate) fn remove_job(&self, id: &str) -> Result<(), StoreError> {
        self.write(|change| {
            change.open_table(JOBS)?.remove(id)?;
            change.open_table(PROGRAMS)?.remove(id)?;
            let mut texts = change.open_table(TEXTS)?;
            let kinds: Result<Vec<String>, StorageError> = texts
                .range((id, "")..=(id, "\u{10ffff}"))?
                .map(|entry| entry.map(|(key, _)| key.value().1.to_owned()))
                .collect();
            for kind in kinds? {
                texts.remove((id, kind.as_str()))?;
            }
            remove_steps(change, id)
        })
    }

    /// A text of a finished job.
    pub(crate) fn text(&self, id: &str, kind: &str) -> Result<Option<String>, StoreError> {
        self.with(|database| {
            let texts = database.begin_read()?.open_table(TEXTS)?;
            Ok(texts.get((id, kind))?.map(|text| text.value().to_owned()))
        })
    }

    /// Stores finished steps of a job, the first of them number `first`.
    pub(crate) fn put_steps(
        &self,
        id: &str,
        first: u64,
        steps: &[Vec<u8>],
    ) -> Result<(), StoreError> {
        self.write(|change| {
            let mut table = change.open_table(STEPS)?;
            for (number, step) in (first..).zip(steps) {
                table.insert((id, number), step.as_slice())?;
            }
            Ok(())
        })
    }

    /// A finished step of a job.
    pub(crate) fn step(&self, id: &str, number: u64) -> Result<Option<Vec<u8>>, StoreError> {
        self.with(|database| {
            let steps = database.begin_read()?.open_table(STEPS)?;
            Ok(steps.get((id, number))?.map(|step| step.value().to_owned()))
        })
    }

    fn pairs(
        &self,
        table: TableDefinition<'_, &'static str, &'static str>,
    ) -> Result<Vec<(String, String)>, StoreError> {
        self.with(|database| {
            let table = database.begin_read()?.open_table(table)?;
            let mut all = Vec::new();
            for entry in table.iter()? {
                let (key, value) = entry?;
                all.push((key.value().to_owned(), value.value().to_owned()));
            }
            Ok(all)
        })
    }

    fn write(
        &self,
        change: impl Fn(&WriteTransaction) -> Result<(), StoreError>,
    ) -> Result<(), StoreError> {
        self.with(|database| {
            let transaction = database.begin_write()?;
            change(&transaction)?;
            Ok(transaction.commit()?)
        })
    }

    /// Uses the database; one that failed is closed, and opened again for the next.
    fn with<T>(&self, work: impl Fn(&Database) -> Result<T, StoreError>) -> Result<T, StoreError> {
        let done = match self.open_one(&work) {
            Some(done) => done,
            None => {
                let mut own = self.database.write().unwrap_or_else(PoisonError::into_inner);
                if own.is_none() {
                    *own = Some((self.open)()?);
                }
                own.as_ref().map_or_else(|| Err(StorageError::DatabaseClosed.into()), &work)
            }
        };
        if done.as_ref().is_err_and(StoreError::is_final) {
            *self.database.write().unwrap_or_else(PoisonError::into_inner) = None;
        }
        done
    }

    /// Does `work` if the database is open.
    fn open_one<T>(
        &self,
        work: impl FnOnce(&Database) -> Result<T, StoreError>,
    ) -> Option<Result<T, StoreError>> {
        let shared = self.database.read().unwrap_or_else(PoisonError::into_inner);
        shared.as_ref().map(work)
    }
}

fn remove_steps(change: &WriteTransaction, id: &str) -> Result<(), StoreError> {
    let mut steps = change.open_table(STEPS)?;
    steps.retain_in((id, 0)..=(id, u64::MAX), |_, _| false)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU64, Ordering};

    use redb::StorageBackend;

    use super::*;

    /// A disk with so many bytes, which stay there when the database is closed.
    #[derive(Clone, Debug)]
    struct Disk {
        bytes: Arc<RwLock<Vec<u8>>>,
        most: Arc<AtomicU64>,
    }

    impl StorageBackend for Disk {
        fn len(&self) -> io::Result<u64> {
            Ok(self.bytes.read().unwrap().len() as u64)
        }

        fn read(&self, offset: u64, out: &mut [u8]) -> io::Result<()> {
            let start = offset as usize;
            out.copy_from_slice(&self.bytes.read().unwrap()[start..start + out.len()]);
            Ok(())
        }

        fn set_len(&self, len: u64) -> io::Result<()> {
            if len > self.most.load(Ordering::Relaxed) {
                return Err(io::ErrorKind::StorageFull.into());
            }
            self.bytes.write().unwrap().resize(len as usize, 0);
            Ok(())
        }

        fn sync_data(&self) -> io::Result<()> {
            Ok(())
        }

        fn write(&self, offset: u64, data: &[u8]) -> io::Result<()> {
            let start = offset as usize;
            self.bytes.write().unwrap()[start..start + data.len()].copy_from_slice(data);
            Ok(())
        }
    }

    #[test]
    fn a_full_disk_is_told_and_everything_before_it_is_still_there() {
        let disk = Disk { bytes: Arc::default(), most: Arc::new(AtomicU64::new(8 << 20)) };
        let backend = disk.clone();
        let store =
            Store::on(move || Database::builder().create_with_backend(backend.clone())).unwrap();
        store.put_material("small", "body").unwrap();
        let large = "x".repeat(16 << 20);
        assert!(store.put_material("large", &large).is_err());
        assert_eq!(store.materials().unwrap(), [("small".to_owned(), "body".to_owned())]);
        disk.most.store(1 << 30, Ordering::Relaxed);
        store.put_material("large", &large).unwrap();
        assert_eq!(store.materials().unwrap().len(), 2);
    }

    #[test]
    fn a_file_that_is_no_store_is_refused_with_its_name_and_a_remedy() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(FILE), "x".repeat(10_000)).unwrap();
        let error = Store::new(Some(folder.path())).unwrap_err().to_string();
        assert!(error.contains(FILE) && error.contains("move it away"), "{error}");
    }

    #[test]
    fn a_folder_keeps_what_was_put_into_it() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::new(Some(folder.path())).unwrap();
        store.put_job("a", "{}", "program").unwrap();
        store.put_steps("a", 3, &[vec![1], vec![2]]).unwrap();
        let second = Store::new(Some(folder.path())).unwrap_err().to_string();
        assert!(second.contains("another service"), "{second}");
        drop(store);
        let store = Store::new(Some(folder.path())).unwrap();
        assert_eq!(store.step("a", 4).unwrap(), Some(vec![2]));
        assert_eq!(store.program("a").unwrap().as_deref(), Some("program"));
        store.finish_job("a", "{}", &[("results".into(), "text".into())]).unwrap();
        assert_eq!(store.step("a", 4).unwrap(), None);
        assert_eq!(store.text("a", "results").unwrap().as_deref(), Some("text"));
        store.remove_job("a").unwrap();
        assert_eq!(store.text("a", "results").unwrap(), None);
        assert!(store.jobs().unwrap().is_empty());
    }
}
