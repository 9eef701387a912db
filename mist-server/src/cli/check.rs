//! `mist check`: everything that is wrong with programs, without running them.

use std::path::PathBuf;

use mist_engine::{Options, compile};

use super::{
    print,
    run::mode,
    source::Source,
    stop::{Fate, Stop},
};
use crate::{
    disk::DiskFiles,
    report::{self, MessageFormat},
};

/// Look for mistakes in programs without running them.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist check paint.mist
  mist check --message-format json paint.mist     one JSON object per mistake, for editors")]
pub(super) struct Args {
    /// Programs.
    #[arg(required = true)]
    programs: Vec<PathBuf>,
    /// Accept what NIST's program accepts.
    #[arg(long)]
    compat: bool,
    /// Who reads the diagnostics.
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    message_format: MessageFormat,
}

/// Checks the programs.
pub(super) fn check(args: &Args) -> Result<(), Stop> {
    let mut fate = Fate::Good;
    for path in &args.programs {
        let source = Source::read(path)?;
        let files = DiskFiles::beside(path).shared();
        let options = Options { mode: mode(args.compat), job: source.stem(), ..Options::default() };
        match compile(&source.text, files, &options) {
            Ok(_) if args.message_format == MessageFormat::Human => {
                print(&format!("{}: no mistake found\n", source.name()))?;
            }
            Ok(_) => {}
            Err(diagnostics) => {
                report::tell(&diagnostics, &source.name(), &source.text, args.message_format);
                fate = Fate::Refused;
            }
        }
    }
    fate.done()
}
