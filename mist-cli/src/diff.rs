//! `mist diff`: what two pictures of the same view differ in, and whether it is seen.

use std::{
    fs,
    path::{Path, PathBuf},
};

use mist_format::number::general;
use pictures::{
    difference::{self, ComparisonSettings, DetectionSummary, PictureDifference},
    image::{Encoding, Image, PictureFormat},
    visible::Viewing,
};
use rise_bridge::write::{self, Graph, Series};

use super::{
    error::CommandError,
    flags::JsonFlag,
    output::{print, write_file},
    plot,
    threads::pool,
};

/// Compare two pictures: which part of the difference an observer sees.
///
/// Prints the percentages of the pixels where a difference is seen with a probability above 75 %
/// and above 95 % (HDR-VDP), with CIEDE2000 and FLIP beside them. A PNG is encoded sRGB whose
/// white has --white cd/m²; EXR and PFM with one channel are luminance in cd/m²; colours of EXR,
/// HDR and PFM have the luminance Y × --scale.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist diff render.png photo.png
  mist diff test.exr reference.exr --compat --json --display-size 0.375x0.300 --display-pixels 1280x1024 --distance 0.5
  mist diff test.hdr reference.hdr --scale 179 --map seen.png --overlay where.png
  mist diff render.png photo.png --plot seen.pdf")]
pub(super) struct DiffArgs {
    /// Picture to judge: .png, .exr, .hdr, .pfm.
    test: PathBuf,
    /// Picture that it should look like.
    reference: PathBuf,
    /// Reproduce the two deviations of HDR-VDP 1.7 on which its numbers depend.
    #[arg(long)]
    compat: bool,
    #[command(flatten)]
    json: JsonFlag,
    /// Width and height of the display in metres.
    #[arg(long, value_name = "WxH", default_value = "0.375x0.300", value_parser = pair)]
    display_size: [f64; 2],
    /// Columns and rows of the display.
    #[arg(long, value_name = "WxH", default_value = "1280x1024", value_parser = pair)]
    display_pixels: [f64; 2],
    /// Distance from the eye to the display in metres.
    #[arg(long, value_name = "M", default_value_t = 0.5)]
    distance: f64,
    /// Luminance of white in cd/m².
    #[arg(long, value_name = "CD/M2", default_value_t = 80.0)]
    white: f64,
    /// Luminance in cd/m² of the linear colour with Y = 1.
    #[arg(long, value_name = "CD/M2", default_value_t = 1.0)]
    scale: f64,
    /// Give the predictor of Daly (1993) too; its contrast is not calibrated.
    #[arg(long)]
    daly: bool,
    /// Write the map of probabilities: .png (255 is 1), .exr or .pfm.
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
    /// Write the reference in grey with what is seen in colour: yellow above 75 %, red above 95 %.
    #[arg(long, value_name = "FILE")]
    overlay: Option<PathBuf>,
    /// Draw the part of the pixels over the probability with which a difference is seen: .svg, .png or
    /// .pdf.
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
}

/// Two numbers with an x between them.
fn pair(text: &str) -> Result<[f64; 2], String> {
    let numbers = text.split_once(['x', 'X', '×']).and_then(|(a, b)| {
        let number = |word: &str| word.trim().parse::<f64>().ok();
        Some([number(a)?, number(b)?])
    });
    numbers.ok_or_else(|| "must be two numbers like 0.375x0.300".into())
}

/// Compares the pictures.
pub(super) fn diff(args: &DiffArgs) -> Result<(), CommandError> {
    let refused = |error: &dyn std::fmt::Display| CommandError::Refused(error.to_string());
    let viewing = Viewing::new(args.display_size, args.display_pixels, args.distance)
        .map_err(|error| refused(&error))?;
    let formats = [format_of(args.map.as_deref())?, format_of(args.overlay.as_deref())?];
    let (test, reference) = (read(&args.test)?, read(&args.reference)?);
    let settings = ComparisonSettings {
        viewing,
        white: args.white,
        scale: args.scale,
        compat: args.compat,
        daly: args.daly,
    };
    let compare = || difference::compare(&test, &reference, &settings);
    let found = pool(0)?.install(compare).map_err(|error| refused(&error))?;
    if let (Some(path), Some(format)) = (&args.map, formats[0]) {
        // Probabilities are written as they are, in PNG too.
        let encoding = if format == PictureFormat::Png { Encoding::Srgb } else { Encoding::Linear };
        save(path, &found.map_image(encoding), format)?;
    }
    if let (Some(path), Some(format)) = (&args.overlay, formats[1]) {
        save(path, &found.overlay(), format)?;
    }
    if let Some(path) = &args.plot {
        plot::save(path, write::plot_graphs("visible differences", &[graph(&found)]))?;
    }
    print(&if args.json.json { format!("{}\n", found.json()) } else { describe(&found) })
}

/// The part of the pixels whose difference is seen with more than a probability.
fn graph(found: &PictureDifference) -> Graph {
    let points = |above: &dyn Fn(f64) -> f64| {
        (0..100).map(|percent| f64::from(percent) / 100.0).map(|p| (p, above(p))).collect()
    };
    Graph {
        across: "probability with which an observer sees the difference".into(),
        up: "pixels above it (%)".into(),
        series: vec![Series {
            label: "HDR-VDP".into(),
            points: points(&|p| found.map.percent_above(p)),
            ..Series::default()
        }],
        is_linear: true,
        ..Graph::default()
    }
}

/// The format that a picture called `path` is written in.
fn format_of(path: Option<&Path>) -> Result<Option<PictureFormat>, CommandError> {
    let Some(path) = path else { return Ok(None) };
    match PictureFormat::of_name(&path.to_string_lossy()) {
        Some(format) if format != PictureFormat::Hdr => Ok(Some(format)),
        _ => {
            let name = path.display();
            Err(CommandError::Refused(format!(
                "{name}: pictures are written as .png, .exr or .pfm"
            )))
        }
    }
}

fn read(path: &Path) -> Result<Image, CommandError> {
    let name = path.display();
    let bytes = fs::read(path)
        .map_err(|error| CommandError::Refused(format!("cannot read {name}: {error}")))?;
    Image::read(&bytes).map_err(|error| CommandError::Refused(format!("{name}: {error}")))
}

fn save(path: &Path, image: &Image, format: PictureFormat) -> Result<(), CommandError> {
    let bytes = image.write(format).map_err(|error| {
        CommandError::Failed(format!("cannot write {}: {error}", path.display()))
    })?;
    write_file(path, &bytes)
}

/// The numbers for people.
fn describe(found: &PictureDifference) -> String {
    let ComparisonSettings { viewing, compat, white, .. } = &found.settings;
    let [width, height] = found.map.size();
    let [least, most] = found.reference.range();
    let habits = if *compat { ", with the habits of HDR-VDP 1.7" } else { "" };
    let mut text = format!(
        "{}   (HDR-VDP 1{habits}, {} pixels per degree, {} m, Y {}–{} cd/m2, {width}x{height})\n",
        percentages(&found.detection),
        general(viewing.pixels_per_degree(), 4),
        general(viewing.distance_m(), 4),
        general(least, 4),
        general(most, 4),
    );
    if let Some(daly) = &found.daly {
        text += &format!("{}   (Daly 1993, not calibrated)\n", percentages(daly));
    }
    let colour = &found.colour;
    text += &format!(
        "CIEDE2000: mean {:.3}, 95 % below {:.3}, largest {:.3}   (white {} cd/m2)\n",
        colour.mean,
        colour.p95,
        colour.max,
        general(*white, 4),
    );
    text += &match &found.flip {
        Ok(flip) => format!("FLIP: mean {:.4}, largest {:.4}\n", flip.mean, flip.max),
        Err(error) => format!("FLIP: none ({error})\n"),
    };
    text
}

fn percentages(seen: &DetectionSummary) -> String {
    format!("P>75%: {:.2} %   P>95%: {:.2} %", seen.p75_percent, seen.p95_percent)
}
