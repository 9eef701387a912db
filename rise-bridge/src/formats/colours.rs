//! The files of colour tables: those formats that HTTP has, too, and CSV, PNG and PDF.

use std::path::Path;

use mist_engine::colour::ColourTable;
use mist_format::program::ColourKey;

use super::{ColourWriter, FileFormat, of_colours};
use crate::write::{self, Style, WriteError};

/// A format of files of colour tables.
#[derive(Clone, Copy, Debug)]
pub struct ColourFormat {
    /// Its content, for people.
    pub title: &'static str,
    /// Extension of its files, without the dot.
    pub extension: &'static str,
    /// The writer of its text.
    pub writer: ColourWriter,
    /// The bytes of a file with this text.
    encode: fn(String) -> Result<Vec<u8>, WriteError>,
}

/// Formats of files alone.
static FILES: [ColourFormat; 4] = [
    ColourFormat {
        title: "colour table, CSV",
        extension: "csv",
        writer: ColourWriter {
            key: ColourKey::Table,
            by_component: false,
            text: |table, _, style| write::csv(table, style),
        },
        encode: plain,
    },
    ColourFormat {
        title: "spectra, CSV",
        extension: "csv",
        writer: ColourWriter {
            key: ColourKey::Spectra,
            by_component: true,
            text: write::csv_spectra,
        },
        encode: plain,
    },
    ColourFormat { title: "picture, PNG", extension: "png", writer: PLOT, encode: write::png },
    ColourFormat { title: "picture, PDF", extension: "pdf", writer: PLOT, encode: write::pdf },
];

/// The picture of a table as SVG.
const PLOT: ColourWriter = ColourWriter {
    key: ColourKey::Plot,
    by_component: false,
    text: |table, _, _| Ok(write::plot(table)),
};

fn plain(text: String) -> Result<Vec<u8>, WriteError> {
    Ok(text.into_bytes())
}

impl ColourFormat {
    /// Every format.
    pub fn all() -> impl Iterator<Item = Self> {
        let of = |(format, writer): (&'static FileFormat, _)| Self {
            title: format.title,
            extension: format.extension,
            writer,
            encode: plain,
        };
        of_colours().map(of).chain(FILES)
    }

    /// The format of the file `name` for `key` of COLOR: by its extension, else the format with
    /// which the list begins.
    pub fn of_key(key: ColourKey, name: &str) -> Option<Self> {
        let mut formats = Self::all().filter(|format| format.writer.key == key);
        let first = formats.next()?;
        Some(formats.find(|format| format.is_of(name)).unwrap_or(first))
    }

    /// The format of the file `name`, by its extension.
    pub fn of_file(name: &str) -> Option<Self> {
        Self::all().find(|format| format.is_of(name))
    }

    /// True if `name` has the extension of the format.
    pub fn is_of(&self, name: &str) -> bool {
        let extension = Path::new(name).extension().and_then(|extension| extension.to_str());
        extension.is_some_and(|extension| extension.eq_ignore_ascii_case(self.extension))
    }

    /// The extensions for a message: `.mtab, .mspd, .json, .svg, .csv, .png and .pdf`.
    pub fn extensions() -> String {
        let mut all: Vec<String> = Vec::new();
        for format in Self::all() {
            let extension = format!(".{}", format.extension);
            if !all.contains(&extension) {
                all.push(extension);
            }
        }
        let last = all.pop().unwrap_or_default();
        format!("{} and {last}", all.join(", "))
    }

    /// The bytes of the file of `table`; of the Stokes component 0 … 3 for I, Q, U, V if they have
    /// files of their own.
    ///
    /// # Errors
    ///
    /// If the format has no file for the table.
    pub fn bytes(
        &self,
        table: &ColourTable,
        component: usize,
        style: Style,
    ) -> Result<Vec<u8>, WriteError> {
        (self.encode)((self.writer.text)(table, component, style)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_chooses_the_format() {
        let title = |key, name| ColourFormat::of_key(key, name).unwrap().title;
        assert_eq!(title(ColourKey::Plot, "a.PNG"), "picture, PNG");
        assert_eq!(title(ColourKey::Plot, "a.svg"), "picture");
        assert_eq!(title(ColourKey::Table, "a.csv"), "colour table, CSV");
        assert_eq!(title(ColourKey::Spectra, "a.csv"), "spectra, CSV");
        assert_eq!(title(ColourKey::Table, "a.txt"), "colour table");
        assert_eq!(ColourFormat::of_file("a.csv").unwrap().title, "colour table, CSV");
        assert!(ColourFormat::of_file("a.txt").is_none());
        assert_eq!(ColourFormat::extensions(), ".mtab, .mspd, .json, .svg, .csv, .png and .pdf");
    }
}
