//! `mist convert`: old programs and documents of NIST's Windows program become programs.

use std::path::PathBuf;

use mist_format::convert::ConvertError;

use super::{
    error::{CommandError, ExitStatus},
    output::{print, write_file},
    report::{self, MessageFormat},
};

/// Turn a document of NIST's Windows program, or an old program, into a program of today.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist convert coating.mst -o coating.mist
  mist convert old.mist")]
pub(super) struct ConvertArgs {
    /// The document or the program.
    file: PathBuf,
    /// File for the program [default: standard output].
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
}

/// Converts the file.
pub(super) fn convert(args: &ConvertArgs) -> Result<(), CommandError> {
    let name = args.file.display();
    let bytes = std::fs::read(&args.file)
        .map_err(|error| CommandError::Refused(format!("cannot read {name}: {error}")))?;
    let text =
        mist_format::convert::convert(&bytes).map_err(|error| refused(error, args, &bytes))?;
    match &args.output {
        None => print(&text),
        Some(path) => write_file(path, text.as_bytes()),
    }
}

/// Says why the file cannot be converted, with the places where it is a program.
fn refused(error: ConvertError, args: &ConvertArgs, bytes: &[u8]) -> CommandError {
    let name = args.file.display().to_string();
    match &error {
        ConvertError::Program(found) => {
            let text = mist_format::decode(bytes);
            report::print_diagnostics(found, &name, &text, MessageFormat::Human);
            CommandError::Reported(ExitStatus::Refused)
        }
        ConvertError::Incomplete { text, found } => {
            report::print_diagnostics(
                found,
                &format!("{name}, converted"),
                text,
                MessageFormat::Human,
            );
            CommandError::Reported(ExitStatus::Refused)
        }
        ConvertError::Document(_) => CommandError::Refused(format!("{name}: {error}")),
    }
}
