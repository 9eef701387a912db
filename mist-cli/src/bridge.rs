//! `mist bridge`: the materials of a RISE scene as tables, and scenes that show them.

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

use mist_engine::material::query;
use mist_runner::files::{AtomicFile, DiskFiles};
use pictures::image::{Image, PictureFormat};
use rise_bridge::rise::{
    product::{self, BridgeFiles, BridgeOptions},
    stack,
};

use super::{
    error::CommandError,
    flags::{IlluminantFlag, LambdaFlag, LampBasisName},
    input::InputText,
    material::{not_exported, refused},
    output::print,
    threads::ThreadsFlag,
};

mod deferred;
mod render;

/// Compute the materials of a RISE scene and write the scene with their tables.
///
/// Materials are scene_materials in comments `# mist: NAME = VALUE` inside their chunks; with --derive
/// also lambertian_material, cooktorrance_material and ggx_material by RISE's own parameters. For
/// each one a MIST program over the rings of its table is written and run, and its results become a
/// .RISEdataBSDF file: docs/formats/rise.md. Without --lambda the wavelengths are 380:10:780.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist bridge ball.RISEscene --out ball
  mist bridge ball.RISEscene --derive --bands --lambda 400:10:700 --out ball
  RISE_BIN=/opt/rise/bin/rise mist bridge ball.RISEscene --out ball --render
  mist bridge ball.RISEscene --deferred --filter linear:90 --out ball --render")]
#[command(group = clap::ArgGroup::new("renders").args(["bands", "deferred"]))]
pub(super) struct BridgeArgs {
    /// The scene.
    scene: PathBuf,
    /// Folder for programs, tables and scenes.
    #[arg(long, value_name = "DIR", default_value = ".")]
    out: PathBuf,
    /// Nodes of each polar angle: 46 are 2 degrees apart.
    #[arg(long, value_name = "N", default_value_t = 46, conflicts_with = "deferred")]
    nodes: usize,
    #[command(flatten)]
    lambda: LambdaFlag,
    /// Derive models from RISE's own materials too.
    #[arg(long)]
    derive: bool,
    /// Write tables and scenes with three wavelengths in the place of red, green and blue too.
    #[arg(long)]
    bands: bool,
    /// Let RISE render normals and shadows only, and shade them here: any azimuth, polarization and
    /// spectrum, in the direct light of the scene's directional lights.
    #[arg(long)]
    deferred: bool,
    /// Pixels of a render per pixel of that picture, in each direction.
    #[arg(long, value_name = "N", default_value_t = 2, requires = "deferred")]
    finer: usize,
    /// That picture behind a filter too: linear:ANGLE (degrees from the horizontal,
    /// counter-clockwise), left or right.
    #[arg(long, default_value = "none", requires = "deferred")]
    filter: String,
    /// Stokes vector of the lamps of that picture; 1,0.2,0,0 is 60 % perpendicular.
    #[arg(
        long,
        default_value = "1,0,0,0",
        value_name = "I,Q,U,V",
        allow_hyphen_values = true,
        requires = "deferred"
    )]
    incident: String,
    /// Direction of Q > 0 of that vector: perpendicular to the plane of incidence, or horizontal.
    #[arg(long, value_enum, default_value_t, value_name = "BASIS", requires = "deferred")]
    incident_basis: LampBasisName,
    /// Render the scenes with the program that RISE_BIN names.
    #[arg(long)]
    render: bool,
    /// Make one picture in colours of the renders of --bands or --deferred that lie in --out;
    /// --render does so by itself.
    #[arg(long, requires = "renders", conflicts_with = "render")]
    stack: bool,
    #[command(flatten)]
    illuminant: IlluminantFlag,
    #[command(flatten)]
    threads: ThreadsFlag,
}

/// Wavelengths of tables for which none were asked.
const LAMBDA: &str = "380:10:780";

/// Makes the files, and the pictures if they are wanted.
pub(super) fn bridge(args: &BridgeArgs) -> Result<(), CommandError> {
    let source = InputText::read(&args.scene)?;
    if args.deferred { deferred::deferred(args, &source) } else { tables(args, &source) }
}

fn tables(args: &BridgeArgs, source: &InputText) -> Result<(), CommandError> {
    if !(3..=361).contains(&args.nodes) {
        return Err(CommandError::Refused(format!("--nodes is from 3 to 361, not {}", args.nodes)));
    }
    let renderer = args.render.then(render::Renderer::of_environment).transpose()?;
    let wanted = BridgeOptions {
        nodes: args.nodes,
        wavelengths: query::nodes("lambda", args.lambda.or(LAMBDA)).map_err(refused)?,
        derive: args.derive,
        bands: args.bands,
    };
    let (files, stem) = (DiskFiles::beside(&args.scene).shared(), source.stem());
    let make = |control: &_| product::make(&source.text, &stem, &files, &wanted, control);
    let made = args.threads.run(&stem, make)?.map_err(not_exported)?;
    save(&args.out, &made.files)?;
    print(&told(&args.out, &made))?;
    for scene in renderer.iter().flat_map(|_| &made.scenes) {
        let renderer = renderer.as_ref().expect("there is one for every scene");
        let text = String::from_utf8_lossy(&made.files[scene]).into_owned();
        let images = product::images(&text).map_err(not_exported)?;
        print(&renderer.render(&args.out, scene, &images, render::seen)?)?;
    }
    if args.bands && (args.render || args.stack) {
        let stem = format!("{stem}_bands");
        print(&stacked(
            &args.out,
            &stem,
            &made.bands,
            &wanted.wavelengths,
            &args.illuminant.illuminant,
        )?)?;
    }
    Ok(())
}

/// Makes one picture of the `renders` in a folder, as .exr and .png.
fn stacked(
    folder: &Path,
    stem: &str,
    renders: &[String],
    wavelengths: &[f64],
    illuminant: &str,
) -> Result<String, CommandError> {
    let images = renders.iter().map(|name| render::seen(&folder.join(name)));
    let images = images.collect::<Result<Vec<_>, String>>().map_err(CommandError::Failed)?;
    let picture = stack::stack(&images, wavelengths, illuminant).map_err(not_exported)?;
    let paths = save_image(folder, stem, &picture)?.into_iter();
    Ok(paths.map(|path| format!("{}: of {} renders\n", path.display(), renders.len())).collect())
}

/// Writes `NAME.exr` (linear) and `NAME.png` (sRGB); says where they are.
fn save_image(folder: &Path, name: &str, image: &Image) -> Result<[PathBuf; 2], CommandError> {
    let paths = ["exr", "png"].map(|extension| folder.join(format!("{name}.{extension}")));
    for (path, format) in paths.iter().zip([PictureFormat::Exr, PictureFormat::Png]) {
        let failed = |error: String| CommandError::Failed(format!("{}: {error}", path.display()));
        let bytes = image.write(format).map_err(|error| failed(error.to_string()))?;
        AtomicFile::write_bytes(path, &bytes).map_err(|error| failed(error.to_string()))?;
    }
    Ok(paths)
}

fn save(folder: &Path, files: &BTreeMap<String, Vec<u8>>) -> Result<(), CommandError> {
    let failed = |path: &Path, error: std::io::Error| {
        CommandError::Failed(format!("cannot write {}: {error}", path.display()))
    };
    fs::create_dir_all(folder).map_err(|error| failed(folder, error))?;
    for (name, bytes) in files {
        let path = folder.join(name);
        AtomicFile::write_bytes(&path, bytes).map_err(|error| failed(&path, error))?;
    }
    Ok(())
}

fn told(folder: &Path, made: &BridgeFiles) -> String {
    let mut text = String::new();
    for (name, table) in &made.tables {
        let [r, g, b] = table.reflectance();
        let path = folder.join(name);
        text += &format!(
            "{}: {} x {} nodes, reflectance {r:.4} {g:.4} {b:.4}\n",
            path.display(),
            table.nodes,
            table.nodes
        );
    }
    for scene in &made.scenes {
        text += &format!("{}\n", folder.join(scene).display());
    }
    for reason in &made.skipped {
        text += &format!("not converted: {reason}\n");
    }
    text
}
