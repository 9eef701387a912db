//! The formats of `mist export`.

use std::path::Path;

use super::{Stop, Work, goniometer, klems, polarized, reflection};

/// What is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Format {
    /// Mueller matrices for Mitsuba's measured_polarized.
    Pbsdf,
    /// Reflection of unpolarized light for readers of the RGL's format.
    Bsdf,
    /// ASAM OpenMATERIAL 3D, BRDF lookup table (.xompt, JSON).
    Openmaterial,
    /// GoniometerTable table in the style of ASTM E1392 (.astm).
    Astm,
    /// GoniometerTable table for Ocean (.csv).
    Ocean,
    /// Klems XML for Radiance and WINDOW (.xml).
    Klems,
}

impl Format {
    /// The format that a file of this name has.
    pub(super) fn of_name(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "pbsdf" => Some(Self::Pbsdf),
            "bsdf" => Some(Self::Bsdf),
            "xompt" => Some(Self::Openmaterial),
            "astm" => Some(Self::Astm),
            "csv" => Some(Self::Ocean),
            "xml" => Some(Self::Klems),
            _ => None,
        }
    }

    /// Told when no name says the format.
    pub(super) fn unknown() -> Stop {
        let known = ".pbsdf, .bsdf, .xompt, .astm, .csv and .xml do";
        Stop::Refused(format!(
            "the name of the output does not tell the format ({known}): give --format"
        ))
    }

    /// The wavelengths of a table for which none were asked.
    pub(super) fn wavelengths(self, args: &super::ExportArgs) -> &'static str {
        match self {
            Self::Pbsdf => "450,500,550,600,650",
            Self::Bsdf if args.rgb => "360:10:830",
            Self::Klems => "360:10:830",
            Self::Bsdf | Self::Openmaterial | Self::Astm | Self::Ocean => "400:10:700",
        }
    }

    /// Writes the file and tells about it.
    pub(super) fn write(self, work: &Work<'_>) -> Result<String, Stop> {
        use rise_bridge::goniometer::GoniometerForm;
        match self {
            Self::Pbsdf => polarized::write(work),
            Self::Bsdf => reflection::write(work),
            Self::Openmaterial => goniometer::write(work, GoniometerForm::OpenMaterial),
            Self::Astm => goniometer::write(work, GoniometerForm::Astm),
            Self::Ocean => goniometer::write(work, GoniometerForm::Ocean),
            Self::Klems => klems::write(work),
        }
    }
}
