//! Data files on disk, and results that appear whole or not at all.

use std::{
    fs, io,
    path::{Path, PathBuf},
    sync::Arc,
};

use mist_engine::{FileError, Files};

mod atomic;

pub use atomic::AtomicFile;

/// Environment variable with further folders of data files, as NIST's program reads it.
const PATH_VARIABLE: &str = "SCATMECH";

/// Environment variable with the folders in which RISE looks for the files of scenes.
const MEDIA_VARIABLE: &str = "RISE_MEDIA_PATH";

/// A file that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrittenFile {
    /// Its content in a word or two, such as `results`.
    pub title: &'static str,
    /// Its name.
    pub path: PathBuf,
    /// True if it replaces an older file.
    pub replaces: bool,
}

/// Looks for data files in the working folder, beside the program, and along `SCATMECH`.
#[derive(Clone, Debug)]
pub struct DiskFiles {
    folders: Vec<PathBuf>,
}

impl DiskFiles {
    /// The same, shared.
    pub fn shared(self) -> Arc<dyn Files + Send + Sync> {
        Arc::new(self)
    }

    /// For the program or the material at `path`.
    pub fn beside(path: &Path) -> Self {
        let mut folders = vec![PathBuf::new()];
        let beside = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        folders.extend(beside.map(Path::to_owned));
        if let Some(list) = std::env::var_os(PATH_VARIABLE) {
            folders.extend(std::env::split_paths(&list));
        }
        Self { folders }
    }

    /// For the scene of RISE at `path`: also in the folders of `RISE_MEDIA_PATH`.
    pub fn beside_scene(path: &Path) -> Self {
        let mut files = Self::beside(path);
        if let Some(list) = std::env::var_os(MEDIA_VARIABLE) {
            files.folders.extend(std::env::split_paths(&list));
        }
        files
    }
}

impl Files for DiskFiles {
    fn read(&self, name: &str) -> Result<Arc<str>, FileError> {
        let mut reason = "the name is empty".to_owned();
        for folder in self.folders.iter().filter(|_| !name.is_empty()) {
            match fs::read(folder.join(name)) {
                Ok(bytes) => return Ok(decode(bytes).into()),
                Err(error) if error.kind() == io::ErrorKind::NotFound => reason = self.nowhere(),
                Err(error) => {
                    reason = error.to_string();
                    break;
                }
            }
        }
        Err(FileError { name: name.to_owned(), reason })
    }

    fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = self.folders.iter().flat_map(|each| entries(each)).collect();
        names.sort();
        names.dedup();
        names
    }
}

impl DiskFiles {
    fn nowhere(&self) -> String {
        let shown = self.folders.iter().map(|folder| match folder.as_os_str().is_empty() {
            true => "the working folder".to_owned(),
            false => folder.display().to_string(),
        });
        format!("it is not in {}", shown.collect::<Vec<_>>().join(", "))
    }
}

/// Names of the files in `folder`; none if it cannot be listed.
fn entries(folder: &Path) -> Vec<String> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let files = entries.filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_file()));
    files.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect()
}

/// The text of the bytes of a file, see [`mist_format::decode`].
pub fn decode(bytes: Vec<u8>) -> String {
    mist_format::decode(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_that_are_not_utf_8_are_latin_1() {
        assert_eq!(decode(b"\xb5m".to_vec()), "µm");
        assert_eq!(decode("µm".into()), "µm");
    }

    #[test]
    fn a_file_beside_the_program_is_found_and_a_missing_one_is_explained() {
        let dir = tempfile::tempdir().unwrap();
        fs::write(dir.path().join("gold.nk"), "1 2 3").unwrap();
        let files = DiskFiles::beside(&dir.path().join("a.mist"));
        assert_eq!(&*files.read("gold.nk").unwrap(), "1 2 3");
        assert!(files.names().contains(&"gold.nk".to_owned()));
        let missing = files.read("silver.nk").unwrap_err();
        assert!(missing.reason.contains("it is not in the working folder"), "{missing}");
    }
}
