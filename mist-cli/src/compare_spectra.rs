//! `mist compare-spectra`: measured spectra beside simulated ones.

use std::{fmt::Write as _, path::PathBuf};

use mist_engine::Warning;
use mist_format::number::general;
use rise_bridge::{read, write};
use serde_json::json;
use spectra::{
    Illuminant, Observer, Spectrum,
    compare::{NEEDED_NM, SpectrumComparison, compare},
};

use super::{
    error::CommandError,
    flags::{IlluminantFlag, JsonFlag, ObserverFlag},
    input::InputText,
    output::print,
    plot,
    reporter::Reporter,
};

/// Compare a measured spectrum with a simulated one.
///
/// Prints a table with both, the root mean square of the difference, the factor that brings the
/// simulated spectrum nearest to the measured one, their correlation, and CIEDE2000 between their
/// colours. A file is a text of two columns (wavelength in nm, µm or Å, and value) or an .mspd
/// file; of its rows --row takes one, else both files must have the same number.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist compare-spectra measured.txt simulated.txt
  mist compare-spectra measured.csv pearl.mspd --row 12 --plot pearl.svg --json")]
pub(super) struct CompareSpectraArgs {
    /// Measured: text of two columns, or .mspd.
    measured: PathBuf,
    /// Simulated: text of two columns, or .mspd.
    simulated: PathBuf,
    /// Row of an .mspd file with several, from 1.
    #[arg(long, value_name = "N")]
    row: Option<usize>,
    /// The values of text files are BRDF in 1/sr: for the colours they are multiplied by pi.
    #[arg(long)]
    brdf: bool,
    #[command(flatten)]
    illuminant: IlluminantFlag,
    #[command(flatten)]
    observer: ObserverFlag,
    /// Write a picture of the spectra: .svg, .png or .pdf.
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    json: JsonFlag,
}

/// Spectra of a file with their names, on a scale on which a perfect diffuser is 1.
struct NamedSpectra(Vec<(String, Spectrum)>);

impl NamedSpectra {
    fn read(path: &std::path::Path, args: &CompareSpectraArgs) -> Result<Self, CommandError> {
        let source = InputText::read(path)?;
        let refused = |error: &dyn std::fmt::Display| {
            CommandError::Refused(format!("{}: {error}", source.name()))
        };
        if !source.text.starts_with("# MIST-TABLE") {
            let (spectrum, _) = Spectrum::parse(&source.text).map_err(|error| refused(&error))?;
            let factor = if args.brdf { std::f64::consts::PI } else { 1.0 };
            return Ok(Self(vec![(source.name(), spectrum.map(|v| factor * v))]));
        }
        let table = read::mspd(&source.text).map_err(|error| refused(&error))?;
        let brdf = table.table.quantity.starts_with("brdf");
        let factor = if brdf { std::f64::consts::PI } else { 1.0 };
        let mut all = Vec::new();
        for row in &table.rows {
            let values: Vec<f64> = row.values.iter().map(|v| factor * v).collect();
            let spectrum = Spectrum::new(&table.table.wavelengths, &values);
            let [i, s, phi] = [row.thetai, row.thetas, row.phis].map(|angle| general(angle, 5));
            let name = format!("{} thetai {i} thetas {s} phis {phi}", source.name());
            all.push((name, spectrum.map_err(|error| refused(&error))?));
        }
        match args.row {
            Some(row) if all.len() > 1 => {
                let count = all.len();
                let Some(one) = row.checked_sub(1).and_then(|at| all.into_iter().nth(at)) else {
                    return Err(refused(&format!("there is no row {row}; it has {count}")));
                };
                Ok(Self(vec![one]))
            }
            _ => Ok(Self(all)),
        }
    }
}

/// Compares and tells.
pub(super) fn compare_spectra(
    args: &CompareSpectraArgs,
    reporter: &Reporter,
) -> Result<(), CommandError> {
    let refused = |error: &dyn std::fmt::Display| CommandError::Refused(error.to_string());
    let illuminant =
        Illuminant::parse(&args.illuminant.illuminant).map_err(|error| refused(&error))?;
    let observer = Observer::parse(&args.observer.observer).map_err(|error| refused(&error))?;
    let NamedSpectra(measured) = NamedSpectra::read(&args.measured, args)?;
    let NamedSpectra(simulated) = NamedSpectra::read(&args.simulated, args)?;
    if measured.len() != simulated.len() {
        let (m, s) = (measured.len(), simulated.len());
        return Err(CommandError::Refused(format!(
            "there are {m} measured and {s} simulated spectra; choose one with --row"
        )));
    }
    let mut found = Vec::new();
    for ((m_name, m), (s_name, s)) in measured.iter().zip(&simulated) {
        let comparison = compare(m, s, &illuminant, observer)
            .map_err(|error| CommandError::Refused(format!("{m_name}, {s_name}: {error}")))?;
        reporter.warn(&format!("{m_name}, {s_name}"), coverage(&comparison).as_slice());
        found.push(([m_name.as_str(), s_name.as_str()], comparison));
    }
    if let Some(path) = &args.plot {
        let pictures: Vec<([&str; 2], &SpectrumComparison)> =
            found.iter().map(|(names, comparison)| (*names, comparison)).collect();
        plot::save(path, write::plot_comparisons(&pictures))?;
    }
    reporter.check()?;
    let under = format!("{}, {}", illuminant.name(), observer.name());
    print(&if args.json.json {
        to_json(&found, &under, &reporter.warnings())
    } else {
        describe(&found, &under)
    })
}

/// A warning if the common wavelengths leave out a part of the visible range.
fn coverage(comparison: &SpectrumComparison) -> Option<Warning> {
    let (first, last) = (comparison.wavelengths.first()?, comparison.wavelengths.last()?);
    (*first > NEEDED_NM[0] || *last < NEEDED_NM[1]).then(|| {
        let message = format!(
            "the common wavelengths are {first} to {last} nm: colours and CIEDE2000 depend on the \
             extrapolation"
        );
        Warning::new("spectrum/coverage", message).help("give spectra from 380 to 780 nm")
    })
}

fn to_json(found: &[([&str; 2], SpectrumComparison)], under: &str, warnings: &[Warning]) -> String {
    let lab = |lab: spectra::Lab| [lab.l, lab.a, lab.b];
    let all = found.iter().map(|([measured, simulated], c)| {
        json!({
            "measured": measured,
            "simulated": simulated,
            "rms": c.rms,
            "scale": c.scale,
            "scaled_rms": c.scaled_rms,
            "correlation": c.correlation,
            "ciede2000": c.delta_e,
            "scaled_ciede2000": c.scaled_delta_e,
            "lab": {
                "measured": lab(c.lab[0]), "simulated": lab(c.lab[1]), "scaled": lab(c.lab[2]),
            },
            "table": {
                "wavelength_nm": c.wavelengths,
                "measured": c.measured,
                "simulated": c.simulated,
            },
        })
    });
    let all: Vec<_> = all.collect();
    format!("{}\n", json!({ "colours": under, "warnings": warnings, "comparisons": all }))
}

fn describe(found: &[([&str; 2], SpectrumComparison)], under: &str) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    for ([measured, simulated], c) in found {
        let _ = writeln!(text, "measured: {measured}\nsimulated: {simulated}");
        let _ = writeln!(text, "      nm     measured    simulated   difference       scaled");
        for ((nm, m), s) in c.wavelengths.iter().zip(&c.measured).zip(&c.simulated) {
            let cells = [*m, *s, m - s, c.scale * s].map(|v| format!("{:>12}", general(v, 5)));
            let _ = writeln!(text, "{:>8} {}", general(*nm, 6), cells.join(" "));
        }
        let correlation = c.correlation.map_or_else(|| "none".to_owned(), |r| format!("{r:.4}"));
        let _ = writeln!(
            text,
            "rms {}; best factor {}, rms {} after it; correlation {correlation}\n\
             CIEDE2000 {:.3}, {:.3} after the factor ({under}; perfect diffuser = 1)\n",
            general(c.rms, 4),
            general(c.scale, 5),
            general(c.scaled_rms, 4),
            c.delta_e,
            c.scaled_delta_e,
        );
    }
    text
}
