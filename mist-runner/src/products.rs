//! The files that a colour table becomes.

use std::{
    io,
    path::{Path, PathBuf},
};

use mist_engine::colour::ColourTable;
use rise_bridge::write::{self, Style, WriteError};

use crate::files::AtomicFile;

/// One of the forms of a colour table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Product {
    /// The colours: `.mtab`.
    Table,
    /// The spectra: `.mspd`, one file per Stokes component.
    Spectra,
    /// The colours as JSON.
    Json,
    /// A picture: SVG.
    Picture,
}

/// Why a product is not on disk.
#[derive(Debug, thiserror::Error)]
pub enum ProductError {
    /// The table has no such text.
    #[error("{0}")]
    Text(#[from] WriteError),
    /// The text cannot be written.
    #[error("cannot write {path}: {source}", path = .path.display())]
    Disk {
        /// The file.
        path: PathBuf,
        /// Why not.
        source: io::Error,
    },
}

impl Product {
    /// Every product.
    pub const ALL: [Self; 4] = [Self::Table, Self::Spectra, Self::Json, Self::Picture];

    /// The product that a file of this name holds.
    pub fn of_name(name: &str) -> Option<Self> {
        let extension = Path::new(name).extension()?.to_str()?.to_ascii_lowercase();
        Self::ALL.into_iter().find(|product| product.extension() == extension)
    }

    /// Extension of its files.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Table => "mtab",
            Self::Spectra => "mspd",
            Self::Json => "json",
            Self::Picture => "svg",
        }
    }

    /// What it is, for people.
    pub fn title(self) -> &'static str {
        match self {
            Self::Table => "colour table",
            Self::Spectra => "spectra",
            Self::Json => "colours, JSON",
            Self::Picture => "picture",
        }
    }

    /// Its content type over HTTP.
    pub fn content_type(self) -> &'static str {
        match self {
            Self::Table | Self::Spectra => "text/plain; charset=utf-8",
            Self::Json => "application/json",
            Self::Picture => "image/svg+xml",
        }
    }

    /// Its text; of the spectra those of `component` (0 … 3 for I, Q, U, V).
    pub fn text(
        self,
        table: &ColourTable,
        component: usize,
        style: Style,
    ) -> Result<String, WriteError> {
        match self {
            Self::Table => write::mtab(table, style),
            Self::Spectra => write::mspd(table, component, style),
            Self::Json => write::json(table, style.xyz),
            Self::Picture => Ok(write::plot(table)),
        }
    }

    /// Writes its files and gives their names; `path` is the name of the first.
    pub fn save(
        self,
        table: &ColourTable,
        path: &Path,
        style: Style,
    ) -> Result<Vec<PathBuf>, ProductError> {
        let components = if self == Self::Spectra { table.stokes } else { 1 };
        let save = |component| {
            let text = self.text(table, component, style)?;
            let name = write::component_name(&path.to_string_lossy(), component);
            let path = PathBuf::from(name);
            match AtomicFile::write(&path, &text) {
                Ok(()) => Ok(path),
                Err(source) => Err(ProductError::Disk { path, source }),
            }
        };
        (0..components).map(save).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_their_product() {
        for product in Product::ALL {
            let name = format!("a.b.{}", product.extension());
            assert_eq!(Product::of_name(&name), Some(product));
        }
        assert_eq!(Product::of_name("a.txt"), None);
    }
}
