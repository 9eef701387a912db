//! The store of materials and jobs: one file that outlives the service, or memory.
//!
//! Every change is one transaction: after a crash the file has what was there before it or what
//! was there after it.

use std::{
    collections::BTreeMap,
    fmt, io,
    path::{Path, PathBuf},
    sync::{Arc, PoisonError, RwLock},
};

use redb::{
    Database, DatabaseError, ReadableDatabase, ReadableTable, StorageError, TableDefinition,
    WriteTransaction, backends::InMemoryBackend,
};
use sha2::{Digest, Sha256};

/// Name of the file in the folder of the service.
const FILE: &str = "mist.redb";

/// Bodies of materials by name.
const MATERIALS: TableDefinition<'_, &str, &str> = TableDefinition::new("materials");
/// Clients that stored materials, by name of the material.
const OWNERS: TableDefinition<'_, &str, &str> = TableDefinition::new("owners");
/// Records of jobs, JSON, by id.
const JOBS: TableDefinition<'_, &str, &str> = TableDefinition::new("jobs");
/// Programs of jobs with their files, JSON, by id.
const PROGRAMS: TableDefinition<'_, &str, &str> = TableDefinition::new("programs");
/// Finished steps by job and number.
const STEPS: TableDefinition<'_, (&str, u64), &[u8]> = TableDefinition::new("steps");
/// SHA-256 of the texts of finished jobs by job and kind.
const DIGESTS: TableDefinition<'_, (&str, &str), &[u8]> = TableDefinition::new("digests");
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
    /// A part of it is not what was stored.
    #[error(
        "{0} was damaged in the store: run the job again; check the disk, or restore the file of \
         the store from a copy"
    )]
    Damaged(String),
    /// The library of the store broke down.
    #[error("its file is damaged or was truncated")]
    Broken,
    /// Another service has its file open.
    #[error(
        "the store {path} is open in another service: stop that one, or give another --data",
        path = .0.display()
    )]
    InUse(PathBuf),
    /// Its file cannot be opened.
    #[error(
        "the store {path} cannot be opened: {reason}; restore it from a copy, or move it away, and \
         the service starts with an empty one",
        path = .path.display()
    )]
    Unusable {
        /// The file.
        path: PathBuf,
        /// The reason.
        reason: String,
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
        let Self::Database(error) = self else { return matches!(self, Self::Broken) };
        matches!(**error, Io(_) | PreviousIo | DatabaseClosed | LockPoisoned(_))
    }

    /// The same error of the first use of the file at `path`, with a remedy.
    fn of_opening(self, path: &Path) -> Self {
        match self {
            Self::Database(error) if matches!(*error, redb::Error::DatabaseAlreadyOpen) => {
                Self::InUse(path.to_owned())
            }
            Self::Database(source) => {
                Self::Unusable { path: path.to_owned(), reason: source.to_string() }
            }
            Self::Broken => Self::Unusable { path: path.to_owned(), reason: self.to_string() },
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
                let path = folder.join(FILE);
                make_private(folder, &path).map_err(StorageError::Io)?;
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
            change.open_table(OWNERS)?;
            change.open_table(JOBS)?;
            change.open_table(PROGRAMS)?;
            change.open_table(STEPS)?;
            change.open_table(TEXTS)?;
            change.open_table(DIGESTS)?;
            Ok(())
        })?;
        Ok(store)
    }

    /// Writes nothing of importance, to see that the store can be written.
    pub(crate) fn try_writing(&self) -> Result<(), StoreError> {
        self.write(|change| {
            change.open_table(OWNERS)?.remove("")?;
            Ok(())
        })
    }

    /// Every material: name, body, and the client that stored it if that is known.
    pub(crate) fn materials(&self) -> Result<Vec<(String, String, Option<String>)>, StoreError> {
        let owners: BTreeMap<String, String> = self.pairs(OWNERS)?.into_iter().collect();
        let all = self.pairs(MATERIALS)?.into_iter();
        Ok(all
            .map(|(name, body)| {
                let owner = owners.get(&name).cloned();
                (name, body, owner)
            })
            .collect())
    }

    /// Stores the body of a material that `owner` has sent.
    pub(crate) fn put_material(
        &self,
        name: &str,
        body: &str,
        owner: &str,
    ) -> Result<(), StoreError> {
        self.write(|change| {
            change.open_table(MATERIALS)?.insert(name, body)?;
            change.open_table(OWNERS)?.insert(name, owner)?;
            Ok(())
        })
    }

    /// Removes a material.
    pub(crate) fn remove_material(&self, name: &str) -> Result<(), StoreError> {
        self.write(|change| {
            change.open_table(MATERIALS)?.remove(name)?;
            change.open_table(OWNERS)?.remove(name)?;
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
            let mut digests = change.open_table(DIGESTS)?;
            for (kind, text) in texts {
                let digest = Sha256::digest(text);
                digests.insert((id, kind.as_str()), digest.as_slice())?;
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
            let mut digests = change.open_table(DIGESTS)?;
            for kind in kinds? {
                digests.remove((id, kind.as_str()))?;
                texts.remove((id, kind.as_str()))?;
            }
            remove_steps(change, id)
        })
    }

    /// A text of a finished job.
    ///
    /// # Errors
    ///
    /// If the store cannot be read, or the text is not the one that was stored.
    pub(crate) fn text(&self, id: &str, kind: &str) -> Result<Option<String>, StoreError> {
        self.with(|database| {
            let read = database.begin_read()?;
            let text = read.open_table(TEXTS)?.get((id, kind))?.map(|text| text.value().to_owned());
            // A text of version 0.1 has no digest.
            let digest = read.open_table(DIGESTS)?.get((id, kind))?;
            let is_whole = match (&text, digest) {
                (Some(text), Some(digest)) => Sha256::digest(text).as_slice() == digest.value(),
                _ => true,
            };
            if is_whole {
                Ok(text)
            } else {
                Err(StoreError::Damaged(format!("{kind} of the job {id}")))
            }
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
                    *own = Some(unbroken(|| Ok((self.open)()?))?);
                }
                let closed = || Err(StorageError::DatabaseClosed.into());
                own.as_ref().map_or_else(closed, |database| unbroken(|| work(database)))
            }
        };
        if let Err(error) = &done {
            tracing::warn!(%error, "the store failed");
        }
        if done.as_ref().is_err_and(StoreError::is_final) {
            let broken = self.database.write().unwrap_or_else(PoisonError::into_inner).take();
            // Closing a damaged file may fail too.
            let _ = unbroken(|| {
                drop(broken);
                Ok(())
            });
        }
        done
    }

    /// Does `work` if the database is open.
    fn open_one<T>(
        &self,
        work: impl FnOnce(&Database) -> Result<T, StoreError>,
    ) -> Option<Result<T, StoreError>> {
        let shared = self.database.read().unwrap_or_else(PoisonError::into_inner);
        shared.as_ref().map(|database| unbroken(|| work(database)))
    }
}

/// Calls the library of the store, which panics on some damaged files.
fn unbroken<T>(work: impl FnOnce() -> Result<T, StoreError>) -> Result<T, StoreError> {
    let done = std::panic::catch_unwind(std::panic::AssertUnwindSafe(work));
    done.unwrap_or(Err(StoreError::Broken))
}

/// Makes the folder and the file if they are not there, for nobody but their owner.
fn make_private(folder: &Path, file: &Path) -> io::Result<()> {
    let mut maker = std::fs::DirBuilder::new();
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut maker, 0o700);
    maker.recursive(true).create(folder)?;
    let mut opener = std::fs::OpenOptions::new();
    opener.append(true).create(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut opener, 0o600);
    let opened = opener.open(file)?;
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        opened.set_permissions(PermissionsExt::from_mode(0o600))?;
        if std::fs::metadata(folder)?.permissions().mode() & 0o077 != 0 {
            let folder = folder.display().to_string();
            tracing::warn!(folder, "other users can list the folder of the service: chmod 700");
        }
    }
    drop(opened);
    Ok(())
}

fn remove_steps(change: &WriteTransaction, id: &str) -> Result<(), StoreError> {
    let mut steps = change.open_table(STEPS)?;
    steps.retain_in((id, 0)..=(id, u64::MAX), |_, _| false)?;
    Ok(())
}

#[cfg(test)]
mod tests;
