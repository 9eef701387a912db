//! `mist convert`: old programs and documents of NIST's Windows program become programs.

use std::path::PathBuf;

use super::{print, stop::Stop};
use crate::disk::WholeFile;

/// Turn a document of NIST's Windows program, or an old program, into a program of today.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist convert coating.mst -o coating.mist
  mist convert old.mist")]
pub(super) struct Args {
    /// The document or the program.
    file: PathBuf,
    /// File for the program [default: standard output].
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
}

/// Converts the file.
pub(super) fn convert(args: &Args) -> Result<(), Stop> {
    let name = args.file.display();
    let bytes = std::fs::read(&args.file)
        .map_err(|error| Stop::Refused(format!("cannot read {name}: {error}")))?;
    let text = mist_format::convert::convert(&bytes)
        .map_err(|error| Stop::Refused(format!("{name}: {error}")))?;
    match &args.output {
        None => print(&text),
        Some(path) => WholeFile::write(path, &text)
            .map_err(|error| Stop::Failed(format!("cannot write {}: {error}", path.display()))),
    }
}
