//! `mist table`: the colour table of a material, or of a table that NIST's program wrote.

use std::path::{Path, PathBuf};

use mist_engine::{
    colour::ColourTable,
    material::{
        results::{self, ResultColumns},
        table,
    },
    request::{ColourQuery, IncidentLight, PatchList, TableQuery, read},
};
use mist_runner::{
    colours,
    files::{DiskFiles, WrittenFile},
};
use rise_bridge::{formats::ColourFormat, write::Style};
use scattering::Basis;

use super::{
    error::CommandError,
    flags::{CompatFlag, IlluminantFlag, LambdaFlag, ObserverFlag},
    input::InputText,
    material::{prepared, refused},
    plot,
    reporter::Reporter,
    threads::ThreadsFlag,
};

/// Make the colour table of a material, or colour a table of results.
///
/// A MATERIAL.json is {"model": …, "parameters": {…}, "files": {…}}; of a program the model of
/// its first step counts. The extension of the output tells its form: .mtab, .mspd, .json,
/// .csv, .svg, .png, .pdf. Without --lambda the wavelengths are 360:5:830, without --grid the nodes are
/// thetai=0:15:75,thetas=0:15:75,phis=0:30:180, without --output the file is NAME.mtab.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist table paint.json
  mist table paint.json -o paint.csv --plot paint.png
  mist table paint.json --grid thetai=0:10:80,thetas=0:10:80,phis=0:20:180 --lambda 400:20:700 -o paint.mtab
  mist table paint.mist --patches patches.lst --lambda 360:10:750 --stokes -o paint.mtab
  mist table --from results.dat --wavelength wl:nm --value f0,f1,f2,f3 -o paint.mtab")]
pub(super) struct TableArgs {
    /// The material, or a program.
    #[arg(required_unless_present = "from", conflicts_with = "from")]
    material: Option<PathBuf>,
    /// Colour this table of results, written by a MIST program.
    #[arg(long, value_name = "RESULTS", requires = "wavelength", requires = "value")]
    from: Option<PathBuf>,
    /// Column of the wavelength and its unit, such as wl:nm or wl:um.
    #[arg(long, value_name = "COLUMN:UNIT")]
    wavelength: Option<String>,
    /// Column of the spectrum, or four columns for I, Q, U, V.
    #[arg(long, value_name = "COLUMNS")]
    value: Option<String>,
    /// Nodes in degrees: thetai=0:2:90,thetas=0:2:90,phis=0:2:180.
    #[arg(long, value_name = "AXES", conflicts_with = "patches")]
    grid: Option<String>,
    /// Solid angle of a node: point, cell, ring, or circle:ALPHA in degrees.
    #[arg(long, default_value = "point")]
    patch: String,
    /// File with one solid angle per line: thetai thetas phis circle 2 | ring 10 12 |
    /// polygon t p t p …, in degrees.
    #[arg(long, value_name = "FILE")]
    patches: Option<PathBuf>,
    #[command(flatten)]
    lambda: LambdaFlag,
    #[command(flatten)]
    illuminant: IlluminantFlag,
    #[command(flatten)]
    observer: ObserverFlag,
    /// RGB space.
    #[arg(long, default_value = "sRGB")]
    space: String,
    /// none, Bradford, CAT02, CAT16 or VonKries.
    #[arg(long, default_value = "Bradford")]
    adaptation: String,
    /// brdf (1/sr) or factor (pi times it).
    #[arg(long, default_value = "brdf")]
    quantity: String,
    /// A filter before the eye, such as linear(1.57); repeatable.
    #[arg(long, value_name = "FILTER")]
    filter: Vec<String>,
    /// Incident Stokes vector.
    #[arg(long, default_value = "1,0,0,0", value_name = "I,Q,U,V")]
    incident: String,
    /// psps, xyxy or plane.
    #[arg(long, default_value = "psps")]
    basis: String,
    /// Give Q, U and V too, for filters at any angle.
    #[arg(long)]
    stokes: bool,
    /// Significant digits: 9 bring back every f32, 17 every f64.
    #[arg(long, default_value_t = 9)]
    digits: usize,
    /// Give the columns X Y Z too.
    #[arg(long)]
    xyz: bool,
    #[command(flatten)]
    compat: CompatFlag,
    #[command(flatten)]
    threads: ThreadsFlag,
    /// Draw the table into this .svg, .png or .pdf, too.
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Refuse to replace a file that exists.
    #[arg(long)]
    no_clobber: bool,
    /// The file to write [default: the material's name with .mtab].
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// The nodes without --grid and --patches.
const DEFAULT_GRID: &str = "thetai=0:15:75,thetas=0:15:75,phis=0:30:180";

/// Makes the table and writes it.
pub(super) fn table(args: &TableArgs, reporter: &Reporter) -> Result<(), CommandError> {
    let output = args.output_file();
    let format = ColourFormat::of_file(&output.to_string_lossy()).ok_or_else(|| {
        let known = ColourFormat::extensions();
        CommandError::Refused(format!("the name of the output ends with one of {known}"))
    })?;
    if args.no_clobber && output.exists() {
        let error = format!("{} exists, and --no-clobber is given", output.display());
        return Err(CommandError::Refused(error));
    }
    if !(1..=17).contains(&args.digits) {
        return Err(CommandError::Refused(format!(
            "--digits is from 1 to 17, not {}",
            args.digits
        )));
    }
    let table = match &args.from {
        Some(from) => args.coloured(from)?,
        None => args.computed(reporter)?,
    };
    let style = Style { digits: args.digits, xyz: args.xyz };
    let failed = |error: colours::SaveError| CommandError::Failed(error.to_string());
    let mut written = colours::save(format, &table, &output, style).map_err(failed)?;
    if let Some(path) = &args.plot {
        let format = plot::format(path)?;
        written.extend(colours::save(format, &table, path, style).map_err(failed)?);
    }
    for WrittenFile { path, replaces, .. } in written {
        let replaced = if replaces { " (replaces an older file)" } else { "" };
        reporter.say(&format!("{}: {} rows{replaced}\n", path.display(), table.rows.len()))?;
    }
    Ok(())
}

impl TableArgs {
    /// The file to write: in the working folder, named after the material, if none is given.
    fn output_file(&self) -> PathBuf {
        let named = || {
            let source = self.material.as_deref().or(self.from.as_deref());
            let stem = source.and_then(Path::file_stem).unwrap_or("table".as_ref());
            Path::new(stem).with_extension("mtab")
        };
        self.output.clone().unwrap_or_else(named)
    }

    fn colours(&self) -> ColourQuery {
        ColourQuery {
            illuminant: Some(self.illuminant.illuminant.clone()),
            observer: Some(self.observer.observer.clone()),
            space: Some(self.space.clone()),
            adaptation: Some(self.adaptation.clone()),
            quantity: Some(self.quantity.clone()),
            filters: self.filter.clone(),
        }
    }

    /// The table of results, coloured.
    fn coloured(&self, from: &Path) -> Result<ColourTable, CommandError> {
        let source = InputText::read(from)?;
        let (wavelength, value) = (self.wavelength.as_deref(), self.value.as_deref());
        let columns =
            ResultColumns::parse(wavelength.unwrap_or_default(), value.unwrap_or_default())
                .map_err(refused)?;
        let settings = self.colours().settings(Some(&DiskFiles::beside(from)))?;
        let incident = read::<IncidentLight>("incident", &self.incident)?.0;
        let basis: Basis = read("basis", &self.basis)?;
        let light = (incident, basis.name());
        results::table(&source.text, &columns, &source.stem(), &settings, light).map_err(refused)
    }

    /// The table of a material.
    fn computed(&self, reporter: &Reporter) -> Result<ColourTable, CommandError> {
        let path = self.material.as_deref().unwrap_or(Path::new(""));
        let source = InputText::read(path)?;
        let prepared = prepared(path, &source, self.compat.mode(), reporter)?;
        let patches = self.patches.as_deref().map(InputText::read).transpose()?;
        let patches = patches.map(|source| read::<PatchList>("patches", &source.text));
        let no_patches = patches.is_none();
        let query = TableQuery {
            grid: self.grid.clone().or_else(|| no_patches.then(|| DEFAULT_GRID.to_owned())),
            patches: patches.transpose()?,
            patch: Some(self.patch.clone()),
            lambda: self.lambda.lambda.clone(),
            incident: Some(self.incident.clone()),
            basis: Some(self.basis.clone()),
            stokes: self.stokes,
            colours: self.colours(),
            ..TableQuery::default()
        };
        let request = query.request(&source.stem(), Some(&DiskFiles::beside(path)))?;
        reporter.warn(&source.name(), &request.warnings());
        reporter.check()?;
        let made = |control: &_| table::table(&prepared, &request, control);
        let mut table = self.threads.run(&source.stem(), made)?.map_err(refused)?;
        reporter.warn(&source.name(), &table.warnings);
        // With those of the program.
        table.warnings = reporter.warnings();
        Ok(table)
    }
}
