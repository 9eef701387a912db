//! `mist eval`: Mueller matrices of single geometries.

use std::path::{Path, PathBuf};

use mist_engine::material::eval;
use mist_runner::files::DiskFiles;

use super::{
    error::CommandError, flags::CompatFlag, input::read_input, output::print, report,
    reporter::Reporter,
};

/// Mueller matrices of a model in given directions, as JSON.
///
/// The input is {"model": …, "parameters": {…}, "basis": "psps", "geometries": [{"theta_i": …,
/// "theta_s": …, "phi_s": …, "rotation": …}], "files": {…}} with angles in radians, or with
/// "program" in place of model and parameters: a text whose first step is the material. The answer
/// is {"mueller": [[16 numbers, row by row], …]} in 1/sr.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist eval < request.json
  echo '{\"model\":\"Lambertian_BRDF_Model\",\"geometries\":[{\"theta_i\":0.5,\"theta_s\":0.2,\"phi_s\":0}]}' | mist eval")]
pub(super) struct EvalArgs {
    /// File with the request [default: standard input].
    input: Option<PathBuf>,
    #[command(flatten)]
    compat: CompatFlag,
}

/// Answers the request.
pub(super) fn eval(args: &EvalArgs, reporter: &Reporter) -> Result<(), CommandError> {
    let text = read_input(args.input.as_deref())?;
    let beside = args.input.as_deref().unwrap_or(Path::new(""));
    let files = DiskFiles::beside(beside).shared();
    let response = eval::eval(&text, args.compat.mode(), Some(files)).map_err(|error| {
        CommandError::Refused(report::with_help(&error.to_string(), error.help()))
    })?;
    let subject = args.input.as_deref().map_or("request".into(), |path| path.to_string_lossy());
    reporter.warn(&subject, &response.warnings);
    reporter.check()?;
    let text = serde_json::to_string(&response)
        .map_err(|error| CommandError::Failed(format!("the answer has no JSON form: {error}")))?;
    print(&(text + "\n"))
}
