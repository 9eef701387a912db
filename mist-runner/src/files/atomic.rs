//! A file that appears under its name when it is whole, and leaves no trace before.

use std::{
    io::{self, BufWriter, Write},
    path::{Path, PathBuf},
};

use tempfile::NamedTempFile;

/// A file that is being written under a temporary name beside its own.
#[derive(Debug)]
pub struct AtomicFile {
    path: PathBuf,
    file: BufWriter<NamedTempFile>,
}

/// Bytes that are written at a time.
const BUFFER: usize = 1 << 16;

impl AtomicFile {
    /// Begins the file `path` in a folder that exists.
    ///
    /// # Errors
    ///
    /// If nothing can be written there.
    pub fn create(path: &Path) -> io::Result<Self> {
        if path.is_dir() {
            return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder"));
        }
        let folder = match path.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        if !folder.is_dir() {
            let reason = format!("there is no folder {}; make it first", folder.display());
            return Err(io::Error::new(io::ErrorKind::NotFound, reason));
        }
        let mut builder = tempfile::Builder::new();
        builder.prefix(".mist-").suffix(".tmp");
        // What a new file gets before the process's mask: temporary files would be private.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let file = builder.tempfile_in(folder)?;
        Ok(Self { path: path.to_owned(), file: BufWriter::with_capacity(BUFFER, file) })
    }

    /// Writes the whole of `text` to the file `path`; true if it replaces an older file.
    ///
    /// # Errors
    ///
    /// If it cannot be written; an older file of this name is then left as it was.
    pub fn write(path: &Path, text: &str) -> io::Result<bool> {
        Self::write_bytes(path, text.as_bytes())
    }

    /// Writes `bytes` to the file `path`, as [`AtomicFile::write`] does a text.
    ///
    /// # Errors
    ///
    /// The same.
    pub fn write_bytes(path: &Path, bytes: &[u8]) -> io::Result<bool> {
        let mut file = Self::create(path)?;
        file.write_all(bytes)?;
        file.finish()
    }

    /// Gives the file its name; true if it replaces an older file.
    ///
    /// # Errors
    ///
    /// If the rest cannot be written or the name cannot be taken.
    pub fn finish(self) -> io::Result<bool> {
        let file = self.file.into_inner().map_err(io::IntoInnerError::into_error)?;
        let replaces = self.path.exists();
        file.persist(&self.path).map_err(|error| error.error)?;
        Ok(replaces)
    }

    /// The name it will have.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn write_all(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.file.write_all(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn a_file_has_its_name_only_when_it_is_finished() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.dat");
        let mut file = AtomicFile::create(&path).unwrap();
        file.write_all(b"text").unwrap();
        assert!(!path.exists());
        file.finish().unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "text");
    }

    #[test]
    fn a_missing_folder_is_told() {
        let dir = tempfile::tempdir().unwrap();
        let error = AtomicFile::create(&dir.path().join("new/a.dat")).unwrap_err();
        assert!(error.to_string().contains("make it first"), "{error}");
    }

    #[test]
    fn a_file_that_is_dropped_leaves_nothing() {
        let dir = tempfile::tempdir().unwrap();
        drop(AtomicFile::create(&dir.path().join("a.dat")).unwrap());
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_folder_cannot_be_a_file() {
        let dir = tempfile::tempdir().unwrap();
        assert!(AtomicFile::create(dir.path()).is_err());
    }
}
