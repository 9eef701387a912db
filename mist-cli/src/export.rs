//! `mist export`: a material in the formats of renderers.

use std::{
    fs::File,
    io,
    path::{Path, PathBuf},
};

use mist_engine::{
    Control,
    material::{Prepared, query},
};
use mist_runner::files::AtomicFile;
use rise_bridge::{export::ExportError, mitsuba::pbsdf};
use serde_json::json;

use super::{
    material::{not_exported, prepared, refused},
    print,
    source::Source,
    stop::Stop,
    watch::watched,
};

mod format;
mod goniometer;
mod klems;
mod polarized;
mod reflection;

use format::Format;

/// Write a material in the format of a renderer, or compare a table of one with it.
///
/// A MATERIAL.json is {"model": …, "parameters": {…}, "files": {…}}; of a program the model of
/// its first step counts. Its wavelength is set to each of --wavelengths. The file appears when it
/// is whole. docs/formats has a page per format: what is stored, frames, signs, units.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist export gold.json --format pbsdf --wavelengths 450,500,550,600,650 --grid 37x46x91 -o gold.pbsdf
  mist export gold.json --wavelengths 450,500,550,600,650 --grid auto:2 -o gold.pbsdf
  mist export gold.json --plugin --wavelengths 400:10:700 -o gold31.pbsdf
  mist export gold.json --format bsdf --spectral --wavelengths 400:10:700 -o gold.bsdf
  mist export gold.json --format bsdf --rgb -o gold_rgb.bsdf
  mist export gold.json --grid thetai=0:15:75,thetas=0:5:85,phis=0:10:180 -o gold.xompt
  mist export gold.json --grid auto:5 -o gold.xompt
  mist export gold.json --compare measured.pbsdf")]
pub(super) struct ExportArgs {
    /// The material, or a program.
    material: PathBuf,
    /// What is written [default: what the name of the output says].
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Wavelengths in nm: a list, FIRST:STEP:LAST, or both mixed [default: 450,500,550,600,650 for
    /// pbsdf, 360:10:830 for colours, else 400:10:700].
    #[arg(long, value_name = "NM")]
    wavelengths: Option<String>,
    /// Nodes of the table, or auto:PERCENT, the smallest grid on which 95 % of the light is nearer
    /// than that. pbsdf: phi_d x theta_d x theta_h (37x46x91). bsdf: theta_i x side of an image
    /// (24x64), or phi_i x theta_i x side (37x20x48). GoniometerTable tables: degrees
    /// [thetai=0:10:80,thetas=0:5:85,phis=0:10:180].
    #[arg(long, value_name = "GRID")]
    grid: Option<String>,
    /// Even steps of theta_h instead of quadratic ones (pbsdf).
    #[arg(long)]
    uniform: bool,
    /// For our plugin for Mitsuba, which takes any number of wavelengths (pbsdf).
    #[arg(long)]
    plugin: bool,
    /// Linear sRGB under D65 instead of spectra (bsdf).
    #[arg(long, conflicts_with = "spectral")]
    rgb: bool,
    /// Spectra; what bsdf has without --rgb.
    #[arg(long)]
    spectral: bool,
    /// Compare this .pbsdf, measured or computed, with the material; nothing is written.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["output", "format", "grid"])]
    compare: Option<PathBuf>,
    /// Give NIST's numbers, its defects included.
    #[arg(long)]
    compat: bool,
    /// Threads [default: one per processor].
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// The file to write.
    #[arg(short, long, value_name = "FILE", required_unless_present = "compare")]
    output: Option<PathBuf>,
}

/// What every writer gets.
struct Work<'a> {
    args: &'a ExportArgs,
    material: Prepared,
    /// nm.
    wavelengths: Vec<f64>,
    /// Where the material is from.
    source: Source,
    path: &'a Path,
    control: &'a Control,
}

impl Work<'_> {
    /// Where a table with this `quantity` is from, as JSON.
    fn description(&self, quantity: &str) -> String {
        let description = json!({
            "generator": format!("mist {}", env!("CARGO_PKG_VERSION")),
            "material": self.source.stem(),
            "quantity": quantity,
            "compat": self.args.compat,
        });
        description.to_string()
    }

    /// Saves what `write` writes; the file appears when it is whole.
    fn save(
        &self,
        write: impl FnOnce(AtomicFile) -> Result<AtomicFile, ExportError>,
    ) -> Result<(), Stop> {
        let path = self.path.display();
        let failed = |error: io::Error| Stop::Failed(format!("cannot write {path}: {error}"));
        let file = AtomicFile::create(self.path).map_err(failed)?;
        write(file).map_err(not_exported)?.finish().map_err(failed)
    }
}

/// Writes the file, or compares it.
pub(super) fn export(args: &ExportArgs) -> Result<(), Stop> {
    let source = Source::read(&args.material)?;
    let material = prepared(&args.material, &source, args.compat)?;
    let label = source.stem();
    print(&watched(args.threads, &label, |control| done(args, source, material, control))??)
}

fn done(
    args: &ExportArgs,
    source: Source,
    material: Prepared,
    control: &Control,
) -> Result<String, Stop> {
    match (&args.compare, &args.output) {
        (Some(table), _) => compare(&material, table, control),
        (None, Some(path)) => {
            let format =
                args.format.or_else(|| Format::of_name(path)).ok_or_else(Format::unknown)?;
            let usual = format.wavelengths(args);
            let wavelengths = args.wavelengths.as_deref().unwrap_or(usual);
            let wavelengths = query::nodes("wavelengths", wavelengths).map_err(refused)?;
            format.write(&Work { args, material, wavelengths, source, path, control })
        }
        (None, None) => Err(Stop::Refused("--output or --compare is needed".into())),
    }
}

/// The part that `auto:PERCENT` asks for; nothing for other grids.
fn tolerance(grid: &str) -> Result<Option<f64>, Stop> {
    let Some(percent) = grid.strip_prefix("auto:") else { return Ok(None) };
    let part = percent.parse::<f64>().ok().filter(|x| *x > 0.0).map(|x| 0.01 * x);
    let refused = || Stop::Refused(format!("--grid {grid}: expected a percentage above 0"));
    part.map(Some).ok_or_else(refused)
}

fn compare(material: &Prepared, path: &Path, control: &Control) -> Result<String, Stop> {
    let name = path.display();
    let file = File::open(path).map_err(|e| Stop::Refused(format!("cannot read {name}: {e}")))?;
    let file = io::BufReader::new(file);
    let found = pbsdf::compare(file, material, control).map_err(not_exported)?;
    let mut text = format!(
        "{name}: {} nodes compared, {} without numbers, {} below the horizon\n\
         nm\tbrightness\tmean difference\tlargest difference\n",
        found.compared, found.empty, found.below
    );
    for (nm, d) in found.nm.iter().zip(&found.found) {
        text += &format!("{nm}\t{:.6}\t{:.3e}\t{:.3e}\n", d.brightness, d.mean, d.largest);
    }
    Ok(text)
}
