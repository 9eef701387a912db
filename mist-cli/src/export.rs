//! `mist export`: a material in the formats of renderers.

use std::{
    fs::File,
    io,
    path::{Path, PathBuf},
};

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use mist_engine::{Control, material::PreparedMaterial};
use mist_runner::files::AtomicFile;
use rise_bridge::{
    formats::{self, ExportRequest, FileFormat, MaterialWriter},
    mitsuba::pbsdf::{self, PbsdfComparison, StokesSigns},
};

use super::{
    error::CommandError,
    flags::{CompatFlag, LambdaFlag},
    input::InputText,
    material::{not_exported, prepared},
    output::print,
    reporter::Reporter,
    threads::ThreadsFlag,
};

/// Elements that differ by less than this part of m00 are not listed.
const LEAST_DIFFERENCE: f64 = 1e-3;

/// Write a material in the format of a renderer, or compare a table of one with it.
///
/// A MATERIAL.json is {"model": …, "parameters": {…}, "files": {…}}; of a program the model of
/// its first step counts. Its wavelength is set to each of --lambda: without it 450,500,550,600,650
/// for pbsdf, 360:10:830 for colours, 380:10:780 for rise, else 400:10:700. The file appears when
/// it is whole. docs/formats has a page per format: what is stored, frames, signs, units.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist export gold.json --format pbsdf --lambda 450,500,550,600,650 --grid 37x46x91 -o gold.pbsdf
  mist export gold.json --lambda 450,500,550,600,650 --grid auto:2 -o gold.pbsdf
  mist export gold.json --plugin --lambda 400:10:700 -o gold31.pbsdf
  mist export gold.json --format bsdf --spectral --lambda 400:10:700 -o gold.bsdf
  mist export gold.json --format bsdf --rgb -o gold_rgb.bsdf
  mist export gold.json --grid thetai=0:15:75,thetas=0:5:85,phis=0:10:180 -o gold.xompt
  mist export gold.json --grid auto:5 -o gold.xompt
  mist export gold.json --compare measured.pbsdf")]
pub(super) struct ExportArgs {
    /// The material, or a program.
    material: PathBuf,
    /// Format of the file [default: the format that the name of the output says].
    #[arg(long, value_parser = format_parser())]
    format: Option<&'static FileFormat>,
    #[command(flatten)]
    lambda: LambdaFlag,
    /// Nodes of the table, or auto:PERCENT, the smallest grid on which 95 % of the light has a
    /// smaller error. pbsdf: phi_d x theta_d x theta_h (37x46x91). bsdf: theta_i x side of an image
    /// (24x64), or phi_i x theta_i x side (37x20x48). Goniometer tables: degrees
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
    /// Spectra: the default of bsdf.
    #[arg(long)]
    spectral: bool,
    /// Compare this .pbsdf, measured or computed, with the material; nothing is written.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["output", "format", "grid"])]
    compare: Option<PathBuf>,
    #[command(flatten)]
    compat: CompatFlag,
    #[command(flatten)]
    threads: ThreadsFlag,
    /// The file to write.
    #[arg(short, long, value_name = "FILE", required_unless_present = "compare")]
    output: Option<PathBuf>,
}

/// Writes the file, or compares it.
pub(super) fn export(args: &ExportArgs, reporter: &Reporter) -> Result<(), CommandError> {
    let source = InputText::read(&args.material)?;
    let material = prepared(&args.material, &source, args.compat.mode(), reporter)?;
    args.lambda.warn(reporter)?;
    let label = source.stem();
    let said = args.threads.run(&label, |control| done(args, &source, &material, control))??;
    reporter.warn(&source.name(), &material.warnings());
    print(&said)
}

fn done(
    args: &ExportArgs,
    source: &InputText,
    material: &PreparedMaterial,
    control: &Control,
) -> Result<String, CommandError> {
    match (&args.compare, &args.output) {
        (Some(table), _) => compare(material, table, control),
        (None, Some(path)) => {
            let line = save(args.writer(path)?, material, &args.request(source), path, control)?;
            Ok(format!("{}: {line}\n", path.display()))
        }
        (None, None) => Err(CommandError::Refused("--output or --compare is needed".into())),
    }
}

impl ExportArgs {
    /// The writer of the format that the flag or the name of the output says.
    fn writer(&self, path: &Path) -> Result<MaterialWriter, CommandError> {
        let by_name = || FileFormat::of_file(&path.to_string_lossy());
        self.format.or_else(by_name).and_then(FileFormat::material).ok_or_else(|| {
            let known = formats::extensions(formats::of_materials().map(|(format, _)| format));
            CommandError::Refused(format!(
                "the name of the output does not tell the format ({known} do): give --format"
            ))
        })
    }

    fn request(&self, source: &InputText) -> ExportRequest {
        ExportRequest {
            name: source.stem(),
            lambda: self.lambda.lambda.clone(),
            grid: self.grid.clone(),
            uniform: self.uniform,
            plugin: self.plugin,
            rgb: self.rgb,
            compat: self.compat.compat,
            estimate_error: true,
            ..ExportRequest::default()
        }
    }
}

/// Names of formats on the command line, with their titles as help.
fn format_parser() -> impl TypedValueParser<Value = &'static FileFormat> {
    let names = formats::of_materials()
        .map(|(format, _)| PossibleValue::new(format.name).help(format.title));
    PossibleValuesParser::new(names)
        .map(|name| FileFormat::named(&name).expect("the possible values are names of formats"))
}

/// Writes the table into a file that appears when it is whole; gives the line about it.
fn save(
    writer: MaterialWriter,
    material: &PreparedMaterial,
    request: &ExportRequest,
    path: &Path,
    control: &Control,
) -> Result<String, CommandError> {
    let failed = |error: io::Error| {
        CommandError::Failed(format!("cannot write {}: {error}", path.display()))
    };
    let mut file = AtomicFile::create(path).map_err(failed)?;
    let line = writer.write(material, request, &mut file, control).map_err(not_exported)?;
    file.finish().map_err(failed)?;
    Ok(line)
}

fn compare(
    material: &PreparedMaterial,
    path: &Path,
    control: &Control,
) -> Result<String, CommandError> {
    let name = path.display();
    let file =
        File::open(path).map_err(|e| CommandError::Refused(format!("cannot read {name}: {e}")))?;
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
    text += &elements(&found);
    Ok(text)
}

/// Lines about the elements that differ, and the signs of the Stokes components.
fn elements(found: &PbsdfComparison) -> String {
    let elements = found.different_elements(LEAST_DIFFERENCE);
    if elements.is_empty() {
        return "no element differs by more than 0.1 % of m00 on the average\n".to_owned();
    }
    let list: Vec<String> =
        elements.iter().map(|(i, j, d)| format!("m{i}{j} {:.2} %", 100.0 * d)).collect();
    let signs = match found.signs() {
        StokesSigns::Same => {
            "the signs are those of the format: V > 0 turns clockwise seen towards the light"
        }
        StokesSigns::OtherV => {
            "with the opposite sign of V the table fits: it has the other hand of circular \
             polarization"
        }
        StokesSigns::OtherU => {
            "with the opposite sign of U the table fits: it counts azimuths the other way"
        }
        StokesSigns::OtherUAndV => {
            "with the opposite signs of U and V the table fits: its frame is mirrored"
        }
    };
    format!("differences over m00 on the average: {}\n{signs}\n", list.join(", "))
}
