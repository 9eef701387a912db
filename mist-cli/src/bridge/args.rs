//! Arguments of `mist bridge`.

use std::path::PathBuf;

use crate::{
    flags::{IlluminantFlag, LambdaFlag, LampBasisName},
    threads::ThreadsFlag,
};

/// Wavelengths of tables for which none were asked.
pub(super) const LAMBDA: &str = "380:10:780";

/// Compute the materials of a RISE scene and write the scene with their tables.
///
/// Materials are described in comments `# mist: NAME = VALUE` inside their chunks; with --derive
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
pub(crate) struct BridgeArgs {
    /// The scene.
    pub(super) scene: PathBuf,
    /// Folder for programs, tables and scenes.
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub(super) out: PathBuf,
    /// Nodes of each polar angle: 46 are 2 degrees apart.
    #[arg(long, value_name = "N", default_value_t = 46, conflicts_with = "deferred")]
    pub(super) nodes: usize,
    #[command(flatten)]
    pub(super) lambda: LambdaFlag,
    /// Derive models from RISE's own materials too.
    #[arg(long)]
    pub(super) derive: bool,
    /// Write tables and scenes with three wavelengths in the place of red, green and blue too.
    #[arg(long)]
    pub(super) bands: bool,
    /// Let RISE render normals and shadows only, and shade them here: any azimuth, polarization and
    /// spectrum, in the direct light of the scene's directional lights.
    #[arg(long)]
    pub(super) deferred: bool,
    /// Pixels of a render per pixel of that picture, in each direction.
    #[arg(long, value_name = "N", default_value_t = 2, requires = "deferred")]
    pub(super) finer: usize,
    /// That picture behind a filter too: linear:ANGLE (degrees from the horizontal,
    /// counter-clockwise), left or right.
    #[arg(long, default_value = "none", requires = "deferred")]
    pub(super) filter: String,
    /// Stokes vector of the lamps of that picture; 1,0.2,0,0 is 60 % perpendicular.
    #[arg(
        long,
        default_value = "1,0,0,0",
        value_name = "I,Q,U,V",
        allow_hyphen_values = true,
        requires = "deferred"
    )]
    pub(super) incident: String,
    /// Direction of Q > 0 of that vector: perpendicular to the plane of incidence, or horizontal.
    #[arg(long, value_enum, default_value_t, value_name = "BASIS", requires = "deferred")]
    pub(super) incident_basis: LampBasisName,
    /// Render the scenes with the program that RISE_BIN names.
    #[arg(long)]
    pub(super) render: bool,
    /// Make one picture in colours of the renders of --bands or --deferred that lie in --out;
    /// --render does so by itself.
    #[arg(long, requires = "renders", conflicts_with = "render")]
    pub(super) stack: bool,
    #[command(flatten)]
    pub(super) illuminant: IlluminantFlag,
    #[command(flatten)]
    pub(super) threads: ThreadsFlag,
}
