//! `mist color`: spectra in, XYZ, Lab and RGB out.

use mist_engine::Warning;
use serde_json::{Map, Value, json};
use spectra::{
    Spectrum,
    case::{CaseResult, ColourResponse, evaluate},
};

use super::{
    error::CommandError,
    flags::{IlluminantFlag, JsonFlag, ObserverFlag},
    input::read_input,
    output::print,
    reporter::Reporter,
};

/// Colours of spectra: a file with wavelengths and values, or cases as JSON.
///
/// A file of a spectrum has two columns, wavelength (nm, or as its heading says) and reflectance,
/// or with --emission the radiance. A case has `wavelengths` in nm and `values`, or `stokes` with
/// four lists, and an `illuminant`; {"illuminants": …, "cases": […]} has several. The answer to
/// JSON is JSON: XYZ, the white, chromaticity, Lab, and linear and encoded sRGB; with --all, or
/// `rgb` in a case, other spaces and adaptations.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist color paint.csv
  mist color lamp.txt --emission --json
  mist color < cases.json
  echo '{\"wavelengths\":[400,500,600,700],\"values\":[0.1,0.2,0.7,0.8],\"illuminant\":\"D65\"}' | mist color")]
pub(super) struct ColorArgs {
    /// File with a spectrum or with cases [default: standard input].
    input: Option<std::path::PathBuf>,
    #[command(flatten)]
    illuminant: IlluminantFlag,
    #[command(flatten)]
    observer: ObserverFlag,
    /// The file is the spectrum of a light, not a reflectance.
    #[arg(long)]
    emission: bool,
    /// Eight RGB spaces by four adaptations.
    #[arg(long)]
    all: bool,
    #[command(flatten)]
    json: JsonFlag,
}

/// Answers the request.
pub(super) fn color(args: &ColorArgs, reporter: &Reporter) -> Result<(), CommandError> {
    let text = read_input(args.input.as_deref())?;
    let subject = args.input.as_deref().map_or("request".into(), |path| path.to_string_lossy());
    let is_json = text.trim_start().starts_with(['{', '[']);
    let mut request = if is_json {
        serde_json::from_str(&text)
            .map_err(|error| CommandError::Refused(format!("the input is not JSON: {error}")))?
    } else {
        args.case(&text, &subject)?
    };
    if !args.all {
        take_srgb(&mut request);
    }
    let response = evaluate(&request).map_err(|error| CommandError::Refused(error.to_string()))?;
    let warnings: Vec<Warning> = response.warnings.iter().map(Warning::from).collect();
    reporter.warn(&subject, &warnings);
    reporter.check()?;
    if is_json || args.json.json { print_json(&response) } else { print(&describe(&response)) }
}

impl ColorArgs {
    /// The case of a file with a spectrum.
    fn case(&self, text: &str, name: &str) -> Result<Value, CommandError> {
        let (spectrum, _) = Spectrum::parse(text)
            .map_err(|error| CommandError::Refused(format!("{name}: {error}")))?;
        let wavelengths = spectrum.grid().nm();
        let illuminant = if self.emission {
            Value::Null
        } else {
            match self.illuminant.illuminant.parse::<f64>() {
                Ok(kelvin) => json!(kelvin),
                Err(_) => json!(self.illuminant.illuminant),
            }
        };
        Ok(json!({
            "id": name, "wavelengths": wavelengths, "values": spectrum.values(),
            "illuminant": illuminant, "observer": self.observer.observer,
        }))
    }
}

/// Asks for sRGB alone where a case does not choose.
fn take_srgb(request: &mut Value) {
    let chooses = |case: &Map<String, Value>| {
        let expected = case.get("expected").and_then(|expected| expected.get("rgb"));
        case.contains_key("rgb") || expected.is_some()
    };
    let take = |case: &mut Value| {
        if let Some(case) = case.as_object_mut().filter(|case| !chooses(case)) {
            case.insert("rgb".into(), json!([["sRGB", "Bradford"]]));
        }
    };
    match request.get_mut("cases") {
        Some(Value::Array(cases)) => cases.iter_mut().for_each(take),
        Some(_) => {}
        None => take(request),
    }
}

fn print_json(response: &ColourResponse) -> Result<(), CommandError> {
    let text = serde_json::to_string(response)
        .map_err(|error| CommandError::Failed(format!("the answer has no JSON form: {error}")))?;
    print(&(text + "\n"))
}

/// The colours for people.
fn describe(response: &ColourResponse) -> String {
    response.results.iter().map(describe_case).collect()
}

fn describe_case(result: &CaseResult) -> String {
    let mut text = format!("{}\n", result.id);
    let mut line = |name: &str, values: &[f64], digits: usize| {
        let values: Vec<String> = values.iter().map(|x| format!("{x:.digits$}")).collect();
        text += &format!("  {name:<14}{}\n", values.join("  "));
    };
    line("XYZ", &result.xyz, 5);
    if let Some(xy) = &result.xy {
        line("xy", xy, 5);
    }
    if let Some(lab) = &result.lab {
        line("Lab", lab, 2);
    }
    for rgb in &result.rgb {
        let name = if result.rgb.len() > 1 {
            format!("{} {}", rgb.space, rgb.adaptation)
        } else {
            rgb.space.clone()
        };
        let [r, g, b] = rgb.u8;
        let outside = if rgb.in_gamut { "" } else { "  outside of the gamut, clipped" };
        text += &format!("  {name:<14}#{r:02x}{g:02x}{b:02x}  {r} {g} {b}{outside}\n");
    }
    text
}
