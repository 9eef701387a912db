//! `mist fmt`: programs in one layout, comments kept, every expression as it was written.

use std::path::PathBuf;

use mist_format::program::parse;
use mist_runner::files::AtomicFile;
use scattering::Mode;

use super::{
    error::{CommandError, ExitStatus},
    flags::CompatFlag,
    input::InputText,
    output::print,
    report::{self, MessageFormat},
};

/// Print programs in one layout; comments stay, and no result changes.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist fmt paint.mist                 print it
  mist fmt --write *.mist             change the files
  mist fmt --check *.mist             name the files that would change, and exit with 1")]
pub(super) struct FmtArgs {
    /// Programs.
    #[arg(required = true)]
    programs: Vec<PathBuf>,
    /// Change the files instead of printing.
    #[arg(long, conflicts_with = "check")]
    write: bool,
    /// Only name the files that would change.
    #[arg(long)]
    check: bool,
    #[command(flatten)]
    compat: CompatFlag,
}

/// Formats the programs.
pub(super) fn fmt(args: &FmtArgs) -> Result<(), CommandError> {
    let mut status = ExitStatus::Success;
    for path in &args.programs {
        status = status.max(format_one(args, &InputText::program(path)?)?);
    }
    status.into_result()
}

fn format_one(args: &FmtArgs, source: &InputText) -> Result<ExitStatus, CommandError> {
    let dialect = match args.compat.mode() {
        Mode::Sound => mist_format::Dialect::Sound,
        Mode::Compat => mist_format::Dialect::Compat,
    };
    let text = match parse(&source.text, dialect) {
        Ok(program) => program.to_string(),
        Err(diagnostics) => {
            report::print_diagnostics(
                &diagnostics,
                &source.name(),
                &source.text,
                MessageFormat::Human,
            );
            return Ok(ExitStatus::Refused);
        }
    };
    if args.check {
        if text == source.text {
            return Ok(ExitStatus::Success);
        }
        print(&format!("{}\n", source.name()))?;
        return Ok(ExitStatus::Failed);
    }
    if !args.write {
        print(&text)?;
    } else if text != source.text {
        AtomicFile::write(&source.path, &text).map_err(|error| {
            CommandError::Failed(format!("cannot write {}: {error}", source.name()))
        })?;
    }
    Ok(ExitStatus::Success)
}
