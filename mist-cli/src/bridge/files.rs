//! Files of `mist bridge`.

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

use mist_runner::files::AtomicFile;
use pictures::image::{Image, PictureFormat};

use crate::error::CommandError;

/// Writes `files` into `folder`, which is made if it does not exist.
pub(super) fn save(folder: &Path, files: &BTreeMap<String, Vec<u8>>) -> Result<(), CommandError> {
    let failed = |path: &Path, error: std::io::Error| {
        CommandError::Failed(format!("cannot write {}: {error}", path.display()))
    };
    fs::create_dir_all(folder).map_err(|error| failed(folder, error))?;
    for (name, bytes) in files {
        let path = folder.join(name);
        AtomicFile::write_bytes(&path, bytes).map_err(|error| failed(&path, error))?;
    }
    Ok(())
}

/// Writes `NAME.exr` (linear) and `NAME.png` (sRGB); gives their names.
pub(super) fn save_image(
    folder: &Path,
    name: &str,
    image: &Image,
) -> Result<[PathBuf; 2], CommandError> {
    let paths = ["exr", "png"].map(|extension| folder.join(format!("{name}.{extension}")));
    for (path, format) in paths.iter().zip([PictureFormat::Exr, PictureFormat::Png]) {
        let failed = |error: String| CommandError::Failed(format!("{}: {error}", path.display()));
        let bytes = image.write(format).map_err(|error| failed(error.to_string()))?;
        AtomicFile::write_bytes(path, &bytes).map_err(|error| failed(error.to_string()))?;
    }
    Ok(paths)
}
