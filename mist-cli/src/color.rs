//! `mist color`: spectra in, XYZ, Lab and RGB out.

use mist_engine::Warning;

use super::{error::CommandError, input::read_input, output::print, reporter::Reporter};

/// Colours of spectra: one case, or {"illuminants": …, "cases": […]}, as JSON.
///
/// A case has `wavelengths` in nm and `values`, or `stokes` with four lists, and an `illuminant`;
/// the answer has XYZ, the white, chromaticity, Lab, and linear and encoded RGB.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist color < cases.json
  echo '{\"wavelengths\":[400,500,600,700],\"values\":[0.1,0.2,0.7,0.8],\"illuminant\":\"D65\"}' | mist color")]
pub(super) struct ColorArgs {
    /// File with the cases [default: standard input].
    input: Option<std::path::PathBuf>,
}

/// Answers the cases.
pub(super) fn color(args: &ColorArgs, reporter: &Reporter) -> Result<(), CommandError> {
    let text = read_input(args.input.as_deref())?;
    let request = serde_json::from_str(&text)
        .map_err(|error| CommandError::Refused(format!("the input is not JSON: {error}")))?;
    let response = spectra::case::evaluate(&request)
        .map_err(|error| CommandError::Refused(error.to_string()))?;
    let subject = args.input.as_deref().map_or("request".into(), |path| path.to_string_lossy());
    let warnings: Vec<Warning> = response.warnings.iter().map(Warning::from).collect();
    reporter.warn(&subject, &warnings);
    reporter.check()?;
    let text = serde_json::to_string(&response)
        .map_err(|error| CommandError::Failed(format!("the answer has no JSON form: {error}")))?;
    print(&(text + "\n"))
}
