//! Flags of several commands: one name for one thing.

use mist_engine::request::{RequestError, Wavelengths, read, wavelength_warning};
use preview::LampBasis;
use scattering::Mode;

use super::{error::CommandError, report::MessageFormat, reporter::Reporter};

/// The flag `--compat`.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(super) struct CompatFlag {
    /// Read and compute as NIST's program does, its defects included.
    #[arg(long)]
    pub(super) compat: bool,
}

impl CompatFlag {
    /// Sound, or as NIST computes it.
    pub(super) fn mode(self) -> Mode {
        if self.compat { Mode::Compat } else { Mode::Sound }
    }
}

/// The flags of everything that runs a program.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(super) struct EngineFlags {
    #[command(flatten)]
    pub(super) compat: CompatFlag,
    /// Seed of the Monte Carlo modes [default: 1].
    #[arg(long)]
    pub(super) seed: Option<u64>,
}

/// The flag `--lambda`; each command has its own default.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct LambdaFlag {
    /// Wavelengths in nm: a list, FIRST:STEP:LAST, or both mixed [default: see --help].
    #[arg(long, alias = "wavelengths", value_name = "NM")]
    pub(super) lambda: Option<String>,
}

impl LambdaFlag {
    /// The wavelengths in nm of the flag, or of `default`.
    pub(super) fn nm_or(&self, default: &str) -> Result<Vec<f64>, RequestError> {
        let text = self.lambda.as_deref().unwrap_or(default);
        read::<Wavelengths>("lambda", text).map(Wavelengths::into_vec)
    }

    /// Warns of wavelengths that look like another unit than nm.
    ///
    /// # Errors
    ///
    /// If warnings are denied, or the text is not a list of wavelengths.
    pub(super) fn warn(&self, reporter: &Reporter) -> Result<(), CommandError> {
        if let Some(text) = &self.lambda {
            let nm = read::<Wavelengths>("lambda", text)?.into_vec();
            reporter.warn("--lambda", wavelength_warning(&nm).as_slice());
        }
        reporter.check()
    }
}

/// The flag `--illuminant`.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct IlluminantFlag {
    /// Light of the colours: CIE name, colour temperature or D(temperature); for table and preview
    /// also a file.
    #[arg(long, default_value = "D65")]
    pub(super) illuminant: String,
}

/// The flag `--observer`.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct ObserverFlag {
    /// Colour-matching functions.
    #[arg(long, default_value = "CIE1931_2")]
    pub(super) observer: String,
}

/// The flag `--message-format`.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(super) struct MessageFlag {
    /// Form of the diagnostics.
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub(super) message_format: MessageFormat,
}

/// The flag `--json`.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(super) struct JsonFlag {
    /// Print JSON.
    #[arg(long)]
    pub(super) json: bool,
}

/// The values of `--incident-basis`.
#[derive(Clone, Copy, Debug, Default, clap::ValueEnum)]
pub(super) enum LampBasisName {
    /// s is perpendicular to the plane of incidence at every point.
    #[default]
    Plane,
    /// s is horizontal.
    Horizontal,
}

impl From<LampBasisName> for LampBasis {
    fn from(basis: LampBasisName) -> Self {
        match basis {
            LampBasisName::Plane => Self::PlaneOfIncidence,
            LampBasisName::Horizontal => Self::Horizontal,
        }
    }
}
