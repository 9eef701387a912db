//! `mist preview`: a picture of a material on a body, with and without a polarizing filter.

use std::path::{Path, PathBuf};

use mist_engine::request::{ColourQuery, IncidentLight, read};
use mist_runner::files::{AtomicFile, DiskFiles};
use pictures::image::{Image, PictureFormat};
use preview::{
    BodyShape, Environment, Lamp, Polarization, RenderedFilm, Scene, Sky, brightest, mesh::Mesh,
    picture, side_by_side, spectral_exr,
};
use spectra::{ColourPlan, ColourSettings, Grid};

use super::{
    error::CommandError,
    flags::{CompatFlag, IlluminantFlag, LambdaFlag, LampBasisName},
    input::InputText,
    material::{prepared, refused},
    reporter::Reporter,
    threads::ThreadsFlag,
};

/// Render a material on a body: its colours under lamps and sky, with a filter before the camera.
///
/// The material is a MATERIAL.json or a program, of which the model of its first step counts. A
/// white diffuser that faces a lamp has the value 1. The name of the output tells its form: .png
/// (sRGB, 8 bits), .exr or .pfm (linear). Without --lambda the wavelengths are 400:10:700.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist preview examples/gold/gold.mist -o gold.png
  mist preview paint.json --shape torus --bounce --sky 0.3 -o paint.png
  mist preview paint.json --environment hall.exr --samples 256 -o paint.png
  mist preview paint.json --filter linear:90 --side-by-side -o glare.png
  mist preview jade.mist --incident 1,0.2,0,0 --lamp 30,120,5 -o jade.exr
  mist preview gold.mist --shape dragon.ply --spectral -o gold.exr")]
pub(super) struct PreviewArgs {
    /// The material, or a program.
    material: PathBuf,
    /// sphere, torus, knot, plane:ANGLE (degrees from the view), or a file NAME.obj or NAME.ply.
    #[arg(long, default_value = "sphere", value_name = "BODY")]
    shape: String,
    /// Polar angle from the view, azimuth from the right, half-angle of its disc (degrees) and
    /// irradiance of a lamp; the last two may be missing (0, 1). Repeatable.
    #[arg(
        long,
        default_value = "40,120",
        value_name = "POLAR,AZIMUTH[,RADIUS[,E]]",
        allow_hyphen_values = true
    )]
    lamp: Vec<String>,
    /// Radiance of a white diffuser under a uniform sky [default: 0; with --environment the factor of
    /// its luminances, 1].
    #[arg(long, value_name = "FACTOR")]
    sky: Option<f64>,
    /// A picture of the sky in all directions (EXR, HDR, PNG, PFM): azimuth over the columns, the
    /// zenith in the first row; the camera looks at its middle.
    #[arg(long, value_name = "FILE")]
    environment: Option<PathBuf>,
    /// Points of the body light each other, once.
    #[arg(long)]
    bounce: bool,
    /// Stokes vector of the lamps; 1,0.2,0,0 is 60 % perpendicular and 40 % parallel.
    #[arg(long, default_value = "1,0,0,0", value_name = "I,Q,U,V", allow_hyphen_values = true)]
    incident: String,
    /// Direction of Q > 0 of that vector: perpendicular to the plane of incidence, or horizontal.
    #[arg(long, value_enum, default_value_t, value_name = "BASIS")]
    incident_basis: LampBasisName,
    /// none, linear:ANGLE (degrees from the horizontal, counter-clockwise), left or right.
    #[arg(long, default_value = "none")]
    filter: String,
    /// Two pictures: without the filter and with it.
    #[arg(long)]
    side_by_side: bool,
    /// The degree of linear polarization in the place of colours.
    #[arg(long, conflicts_with_all = ["filter", "side_by_side"])]
    dolp: bool,
    /// Multiplies the colours.
    #[arg(long, default_value_t = 1.0)]
    exposure: f64,
    /// Pixels: a square, or WIDTHxHEIGHT.
    #[arg(long, default_value = "512")]
    size: String,
    /// Samples per pixel.
    #[arg(long, default_value_t = 16)]
    samples: usize,
    /// Evaluate the model for every sample; without it, light of lamps in one direction (RADIUS 0)
    /// is interpolated between normals, within 1 part in 1000.
    #[arg(long)]
    exact: bool,
    /// The spectra of the four Stokes components, in an .exr; radiance factors, no filter.
    #[arg(long, conflicts_with_all = ["filter", "side_by_side", "dolp", "exposure"])]
    spectral: bool,
    #[command(flatten)]
    lambda: LambdaFlag,
    #[command(flatten)]
    illuminant: IlluminantFlag,
    #[command(flatten)]
    compat: CompatFlag,
    #[command(flatten)]
    threads: ThreadsFlag,
    /// The file to write.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

/// Most pixels times samples: a picture of 8192² with 16 samples.
const MOST_SAMPLES: usize = 1 << 30;

/// Renders the picture and writes it.
pub(super) fn preview(args: &PreviewArgs, reporter: &Reporter) -> Result<(), CommandError> {
    let format = PictureFormat::of_name(&args.output.to_string_lossy());
    let format = format.filter(|format| *format != PictureFormat::Hdr).ok_or_else(|| {
        CommandError::Refused("the name of the output ends with .png, .exr or .pfm".into())
    })?;
    if args.spectral && format != PictureFormat::Exr {
        return Err(CommandError::Refused("--spectral writes an .exr".into()));
    }
    let scene = args.scene()?;
    let filter = args.polarization()?;
    let source = InputText::read(&args.material)?;
    let material = prepared(&args.material, &source, args.compat.mode(), reporter)?;
    args.lambda.warn(reporter)?;
    let wavelengths = args.lambda.nm_or("400:10:700")?;
    let settings = args.settings()?;
    let made = args.threads.run(&source.stem(), |control| {
        preview::render(&material, &scene, &wavelengths, settings.clone(), control)
    });
    let film = made?.map_err(refused)?;
    reporter.warn(&source.name(), &material.warnings());
    let failed = |error: String| CommandError::Failed(error);
    let grid = Grid::new(&wavelengths).map_err(|error| failed(error.to_string()))?;
    let plan = ColourPlan::new(&grid, settings).map_err(|error| failed(error.to_string()))?;
    let bytes = if args.spectral {
        spectral_exr(&film, &wavelengths)
    } else {
        args.image(&film, &plan, filter)?.write(format)
    };
    let bytes = bytes.map_err(|error| failed(error.to_string()))?;
    AtomicFile::write_bytes(&args.output, &bytes)
        .map_err(|error| failed(format!("{}: {error}", args.output.display())))?;
    let [width, height] = [film.size[0] * (1 + usize::from(args.side_by_side)), film.size[1]];
    reporter.say(&format!("{}: {width} × {height} pixels\n", args.output.display()))?;
    let [plain, seen] = [Polarization::All, filter].map(|filter| brightest(&film, filter));
    reporter.say(&format!(
        "brightest pixel: {plain:.4} without a filter, {seen:.4} in the picture\n"
    ))?;
    let shown = seen * args.exposure;
    if format == PictureFormat::Png && shown > 1.0 {
        reporter.say(&format!(
            "pixels brighter than white keep their hue; --exposure {:.3} shows their brightness\n",
            args.exposure / shown
        ))?;
    }
    Ok(())
}

impl PreviewArgs {
    fn image(
        &self,
        film: &RenderedFilm,
        plan: &ColourPlan,
        filter: Polarization,
    ) -> Result<Image, CommandError> {
        let failed = |error: pictures::image::ImageError| CommandError::Failed(error.to_string());
        let seen = picture(film, plan, filter, self.exposure).map_err(failed)?;
        if !self.side_by_side {
            return Ok(seen);
        }
        let plain = picture(film, plan, Polarization::All, self.exposure).map_err(failed)?;
        side_by_side(&plain, &seen).map_err(failed)
    }

    fn settings(&self) -> Result<ColourSettings, CommandError> {
        let names = ColourQuery::of_factors(&self.illuminant.illuminant);
        Ok(names.settings(Some(&DiskFiles::beside(&self.material)))?)
    }

    fn scene(&self) -> Result<Scene, CommandError> {
        let size = self.pixels()?;
        let samples = size[0].checked_mul(size[1]).and_then(|n| n.checked_mul(self.samples));
        if !samples.is_some_and(|n| (1..=MOST_SAMPLES).contains(&n)) {
            let most = format!("pixels times --samples are 1 to {MOST_SAMPLES}");
            return Err(CommandError::Refused(most));
        }
        if !self.exposure.is_finite() {
            return Err(CommandError::Refused("--exposure is a number".into()));
        }
        Ok(Scene {
            shape: self.body()?,
            lamps: self.lamp.iter().map(|text| lamp(text)).collect::<Result<_, _>>()?,
            light: read::<IncidentLight>("incident", &self.incident)?.0,
            light_basis: self.incident_basis.into(),
            sky: self.sky()?,
            bounce: self.bounce,
            size,
            samples: self.samples,
            exact: self.exact,
            spectra: self.spectral,
        })
    }

    fn sky(&self) -> Result<Sky, CommandError> {
        let usual = if self.environment.is_some() { 1.0 } else { 0.0 };
        let factor = self.sky.unwrap_or(usual);
        if !(factor >= 0.0 && factor.is_finite()) {
            return Err(CommandError::Refused("--sky is not negative".into()));
        }
        match &self.environment {
            _ if factor == 0.0 => Ok(Sky::Dark),
            None => Ok(Sky::Uniform(factor)),
            Some(path) => {
                let refused = |error: &dyn std::fmt::Display| {
                    CommandError::Refused(format!("--environment {}: {error}", path.display()))
                };
                let bytes = std::fs::read(path).map_err(|error| refused(&error))?;
                let picture = Image::read(&bytes).map_err(|error| refused(&error))?;
                if picture.values().iter().any(|value| !value.is_finite()) {
                    return Err(refused(&"it has values that are not numbers"));
                }
                Ok(Sky::Map(Environment::new(&picture, factor)))
            }
        }
    }

    fn pixels(&self) -> Result<[usize; 2], CommandError> {
        let (width, height) = self.size.split_once('x').unwrap_or((&self.size, &self.size));
        match (width.parse(), height.parse()) {
            (Ok(width), Ok(height)) => Ok([width, height]),
            _ => Err(CommandError::Refused(format!("--size is 512 or 640x480, not {}", self.size))),
        }
    }

    fn body(&self) -> Result<BodyShape, CommandError> {
        match self.shape.as_str() {
            "sphere" => return Ok(BodyShape::Sphere),
            "torus" => return Ok(BodyShape::Mesh(Mesh::torus(192))),
            "knot" => return Ok(BodyShape::Mesh(Mesh::knot(96))),
            _ => {}
        }
        if let Some(angle) = self.shape.strip_prefix("plane:") {
            return match angle.parse::<f64>() {
                Ok(angle) if angle.abs() < 90.0 => Ok(BodyShape::Plane(angle.to_radians())),
                _ => Err(CommandError::Refused(format!(
                    "--shape plane:ANGLE is below 90, not {angle}"
                ))),
            };
        }
        let path = Path::new(&self.shape);
        let bytes = |path| {
            let refused =
                |error| CommandError::Refused(format!("cannot read {}: {error}", self.shape));
            std::fs::read(path).map_err(refused)
        };
        let mesh = match path.extension().and_then(|extension| extension.to_str()) {
            Some("obj") => Mesh::from_obj(&InputText::read(path)?.text),
            Some("ply") => Mesh::from_ply(&bytes(path)?),
            _ => {
                let choice = "sphere, torus, knot, plane:ANGLE or a file NAME.obj or NAME.ply";
                return Err(CommandError::Refused(format!(
                    "--shape is {choice}, not {}",
                    self.shape
                )));
            }
        };
        mesh.map(BodyShape::Mesh)
            .map_err(|error| CommandError::Refused(format!("{}: {error}", self.shape)))
    }

    fn polarization(&self) -> Result<Polarization, CommandError> {
        if self.dolp { Ok(Polarization::Degree) } else { filter(&self.filter) }
    }
}

/// The filter that `--filter` names.
pub(super) fn filter(text: &str) -> Result<Polarization, CommandError> {
    match text {
        "none" => return Ok(Polarization::All),
        "left" => return Ok(Polarization::Left),
        "right" => return Ok(Polarization::Right),
        _ => {}
    }
    let angle = text.strip_prefix("linear:").and_then(|text| text.parse::<f64>().ok());
    let angle = angle.filter(|angle| angle.is_finite());
    angle.map(|a| Polarization::Linear(a.to_radians())).ok_or_else(|| {
        CommandError::Refused(format!("--filter is none, linear:ANGLE, left or right, not {text}"))
    })
}

/// `POLAR,AZIMUTH[,RADIUS[,E]]`
fn lamp(text: &str) -> Result<Lamp, CommandError> {
    let refused = || {
        let expected = "POLAR,AZIMUTH[,RADIUS[,E]] in degrees with 0 ≤ RADIUS ≤ 90 and E ≥ 0";
        CommandError::Refused(format!("--lamp is {expected}, not {text}"))
    };
    let numbers: Vec<f64> = text
        .split(',')
        .map(|word| word.trim().parse())
        .collect::<Result<_, _>>()
        .map_err(|_| refused())?;
    let (polar, azimuth, radius, irradiance) = match numbers[..] {
        [polar, azimuth] => (polar, azimuth, 0.0, 1.0),
        [polar, azimuth, radius] => (polar, azimuth, radius, 1.0),
        [polar, azimuth, radius, irradiance] => (polar, azimuth, radius, irradiance),
        _ => return Err(refused()),
    };
    let is_good = numbers.iter().all(|n| n.is_finite())
        && (0.0..=90.0).contains(&radius)
        && irradiance >= 0.0;
    is_good
        .then(|| {
            Lamp::at(polar.to_radians(), azimuth.to_radians(), radius.to_radians(), irradiance)
        })
        .ok_or_else(refused)
}
