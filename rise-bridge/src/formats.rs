//! The file formats that mist writes: one table for the command line, HTTP, jobs, help and documents.

mod colours;
mod export;
mod goniometer;
mod klems;
mod polarized;
mod reflection;
mod rings;

use std::{io::Write, path::Path};

use mist_engine::{Control, colour::ColourTable, material::PreparedMaterial};
use mist_format::program::ColourKey;

pub use colours::ColourFormat;
pub use export::ExportRequest;

use crate::{
    export::ExportError,
    goniometer::GoniometerForm,
    write::{self, Style, WriteError},
};

/// A file format.
#[derive(Debug)]
pub struct FileFormat {
    /// Its name on the command line.
    pub name: &'static str,
    /// Extension of its files, without the dot.
    pub extension: &'static str,
    /// Its content, for people.
    pub title: &'static str,
    /// Media type of its files over HTTP.
    pub media_type: &'static str,
    /// The function that writes it, which tells what it needs.
    pub writer: FormatWriter,
}

/// The writer of a format.
#[derive(Clone, Copy, Debug)]
pub enum FormatWriter {
    /// Writes a colour table as text.
    Colours(ColourWriter),
    /// Evaluates a material and writes its table as bytes.
    Material(MaterialWriter),
}

/// The writer of a colour table.
#[derive(Clone, Copy, Debug)]
pub struct ColourWriter {
    /// The name in the section COLOR whose value is the name of the file.
    pub key: ColourKey,
    /// True if each Stokes component has a file of its own.
    pub by_component: bool,
    /// The text; of the Stokes component 0 … 3 for I, Q, U, V if they have files of their own.
    pub text: fn(&ColourTable, usize, Style) -> Result<String, WriteError>,
}

/// The writer of a material.
#[derive(Clone, Copy, Debug)]
pub struct MaterialWriter {
    /// Fields of the request that the format has, besides those that all have.
    pub options: &'static [&'static str],
    write: fn(
        &PreparedMaterial,
        &ExportRequest,
        &mut dyn Write,
        &Control,
    ) -> Result<String, ExportError>,
}

impl MaterialWriter {
    /// Writes the table of `material` and gives a line about it: its nodes, and between them the
    /// error of interpolation if the request asks for it.
    ///
    /// # Errors
    ///
    /// For a request that the format has no room for, models that are not finite somewhere,
    /// cancellation, and an `out` that does not take the data.
    pub fn write(
        &self,
        material: &PreparedMaterial,
        request: &ExportRequest,
        out: &mut dyn Write,
        control: &Control,
    ) -> Result<String, ExportError> {
        match request.options().find(|option| !self.options.contains(option)) {
            Some(option) => Err(ExportError::refused(option, "the format has no such option")),
            None => (self.write)(material, request, out, control),
        }
    }
}

/// Media type of text tables.
const TEXT: &str = "text/plain; charset=utf-8";
/// Media type of tables that only their readers know.
const BYTES: &str = "application/octet-stream";

/// The colours of a table.
pub static MTAB: FileFormat = FileFormat {
    name: "mtab",
    extension: "mtab",
    title: "colour table",
    media_type: TEXT,
    writer: FormatWriter::Colours(ColourWriter {
        key: ColourKey::Table,
        by_component: false,
        text: |table, _, style| write::mtab(table, style),
    }),
};

/// The spectra of a table.
pub static MSPD: FileFormat = FileFormat {
    name: "mspd",
    extension: "mspd",
    title: "spectra",
    media_type: TEXT,
    writer: FormatWriter::Colours(ColourWriter {
        key: ColourKey::Spectra,
        by_component: true,
        text: write::mspd,
    }),
};

/// The colours of a table as JSON.
pub static JSON: FileFormat = FileFormat {
    name: "json",
    extension: "json",
    title: "colours, JSON",
    media_type: "application/json",
    writer: FormatWriter::Colours(ColourWriter {
        key: ColourKey::Json,
        by_component: false,
        text: |table, _, style| write::json(table, style.xyz),
    }),
};

/// A picture of a table.
pub static SVG: FileFormat = FileFormat {
    name: "svg",
    extension: "svg",
    title: "picture",
    media_type: "image/svg+xml",
    writer: FormatWriter::Colours(ColourWriter {
        key: ColourKey::Plot,
        by_component: false,
        text: |table, _, _| Ok(write::plot(table)),
    }),
};

/// Mueller matrices for Mitsuba.
pub static PBSDF: FileFormat = FileFormat {
    name: "pbsdf",
    extension: "pbsdf",
    title: "Mueller matrices for Mitsuba's measured_polarized",
    media_type: BYTES,
    writer: FormatWriter::Material(MaterialWriter {
        options: &["grid", "uniform", "plugin"],
        write: polarized::write,
    }),
};

/// Reflection of unpolarized light in the format of the RGL.
pub static BSDF: FileFormat = FileFormat {
    name: "bsdf",
    extension: "bsdf",
    title: "reflection of unpolarized light for readers of the RGL's format",
    media_type: BYTES,
    writer: FormatWriter::Material(MaterialWriter {
        options: &["grid", "rgb"],
        write: reflection::write,
    }),
};

/// Rings for RISE.
pub static RISE: FileFormat = FileFormat {
    name: "rise",
    extension: "RISEdataBSDF",
    title: "means over rings for RISE",
    media_type: BYTES,
    writer: FormatWriter::Material(MaterialWriter {
        options: &["nodes", "filter"],
        write: rings::write,
    }),
};

/// ASAM OpenMATERIAL 3D.
pub static OPEN_MATERIAL: FileFormat = FileFormat {
    name: "openmaterial",
    extension: "xompt",
    title: "ASAM OpenMATERIAL 3D, BRDF lookup table, JSON",
    media_type: BYTES,
    writer: FormatWriter::Material(MaterialWriter {
        options: &["grid"],
        write: |material, request, out, control| {
            goniometer::write(GoniometerForm::OpenMaterial, (material, request), out, control)
        },
    }),
};

/// A goniometer table in the style of ASTM E1392.
pub static ASTM: FileFormat = FileFormat {
    name: "astm",
    extension: "astm",
    title: "goniometer table in the style of ASTM E1392",
    media_type: BYTES,
    writer: FormatWriter::Material(MaterialWriter {
        options: &["grid"],
        write: |material, request, out, control| {
            goniometer::write(GoniometerForm::Astm, (material, request), out, control)
        },
    }),
};

/// A goniometer table for Ocean.
pub static OCEAN: FileFormat = FileFormat {
    name: "ocean",
    extension: "csv",
    title: "goniometer table for Ocean",
    media_type: BYTES,
    writer: FormatWriter::Material(MaterialWriter {
        options: &["grid"],
        write: |material, request, out, control| {
            goniometer::write(GoniometerForm::Ocean, (material, request), out, control)
        },
    }),
};

/// Klems XML for Radiance and WINDOW.
pub static KLEMS: FileFormat = FileFormat {
    name: "klems",
    extension: "xml",
    title: "Klems XML for Radiance and WINDOW",
    media_type: BYTES,
    writer: FormatWriter::Material(MaterialWriter { options: &[], write: klems::write }),
};

/// Every format: first those of colour tables, then those of materials.
pub static FORMATS: [&FileFormat; 11] =
    [&MTAB, &MSPD, &JSON, &SVG, &PBSDF, &BSDF, &RISE, &OPEN_MATERIAL, &ASTM, &OCEAN, &KLEMS];

impl FileFormat {
    /// The format with this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        FORMATS.into_iter().find(|format| format.name == name)
    }

    /// The format of a file with this name, by its extension.
    pub fn of_file(name: &str) -> Option<&'static Self> {
        let extension = Path::new(name).extension()?.to_str()?;
        FORMATS.into_iter().find(|format| format.extension.eq_ignore_ascii_case(extension))
    }

    /// The writer, if it needs a colour table.
    pub fn colours(&self) -> Option<ColourWriter> {
        match self.writer {
            FormatWriter::Colours(writer) => Some(writer),
            FormatWriter::Material(_) => None,
        }
    }

    /// The writer, if it needs a material.
    pub fn material(&self) -> Option<MaterialWriter> {
        match self.writer {
            FormatWriter::Colours(_) => None,
            FormatWriter::Material(writer) => Some(writer),
        }
    }
}

/// The formats of colour tables.
pub fn of_colours() -> impl Iterator<Item = (&'static FileFormat, ColourWriter)> {
    FORMATS.into_iter().filter_map(|format| Some((format, format.colours()?)))
}

/// The formats of materials.
pub fn of_materials() -> impl Iterator<Item = (&'static FileFormat, MaterialWriter)> {
    FORMATS.into_iter().filter_map(|format| Some((format, format.material()?)))
}

/// The extensions of `formats` for a message: `.mtab, .mspd, .json and .svg`.
pub fn extensions(formats: impl Iterator<Item = &'static FileFormat>) -> String {
    let all: Vec<String> = formats.map(|format| format!(".{}", format.extension)).collect();
    match all.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => all.concat(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_extensions_identify_a_format() {
        for format in FORMATS {
            assert!(std::ptr::eq(FileFormat::named(format.name).unwrap(), format));
            let file = format!("a.b.{}", format.extension);
            assert!(std::ptr::eq(FileFormat::of_file(&file).unwrap(), format));
        }
        assert!(FileFormat::of_file("a.txt").is_none());
        assert!(FileFormat::of_file("mtab").is_none());
    }

    #[test]
    fn extensions_are_listed_for_messages() {
        let colours = of_colours().map(|(format, _)| format);
        assert_eq!(extensions(colours), ".mtab, .mspd, .json and .svg");
    }
}
