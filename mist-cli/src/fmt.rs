//! `mist fmt`: programs in one layout, comments kept, every expression as it was written.

use std::path::PathBuf;

use mist_format::program::parse;
use mist_runner::files::AtomicFile;
use scattering::Mode;

use super::{
    print,
    run::mode,
    source::Source,
    stop::{Fate, Stop},
};
use crate::report::{self, MessageFormat};

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
    /// Accept what NIST's program accepts.
    #[arg(long)]
    compat: bool,
}

/// Formats the programs.
pub(super) fn fmt(args: &FmtArgs) -> Result<(), Stop> {
    let mut fate = Fate::Good;
    for path in &args.programs {
        fate = fate.max(format_one(args, &Source::program(path)?)?);
    }
    fate.done()
}

fn format_one(args: &FmtArgs, source: &Source) -> Result<Fate, Stop> {
    let dialect = match mode(args.compat) {
        Mode::Sound => mist_format::Dialect::Sound,
        Mode::Compat => mist_format::Dialect::Compat,
    };
    let text = match parse(&source.text, dialect) {
        Ok(program) => program.to_string(),
        Err(diagnostics) => {
            report::tell(&diagnostics, &source.name(), &source.text, MessageFormat::Human);
            return Ok(Fate::Refused);
        }
    };
    if args.check {
        if text == source.text {
            return Ok(Fate::Good);
        }
        print(&format!("{}\n", source.name()))?;
        return Ok(Fate::Failed);
    }
    if !args.write {
        print(&text)?;
    } else if text != source.text {
        AtomicFile::write(&source.path, &text)
            .map_err(|error| Stop::Failed(format!("cannot write {}: {error}", source.name())))?;
    }
    Ok(Fate::Good)
}
