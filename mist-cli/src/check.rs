//! `mist check`: everything that is wrong with programs, without running them.

use std::path::PathBuf;

use mist_engine::{Options, compile};
use mist_runner::files::DiskFiles;

use super::{
    print,
    run::mode,
    source::Source,
    stop::{Fate, Stop},
};
use crate::report::{self, MessageFormat};

/// Look for mistakes in programs without running them.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist check paint.mist
  mist check --message-format json paint.mist     one JSON object per mistake, for editors")]
pub(super) struct CheckArgs {
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
pub(super) fn check(args: &CheckArgs) -> Result<(), Stop> {
    let mut fate = Fate::Good;
    for path in &args.programs {
        let source = Source::program(path)?;
        let files = DiskFiles::beside(path).shared();
        let options = Options { mode: mode(args.compat), job: source.stem(), ..Options::default() };
        let found = match compile(&source.text, files, &options) {
            Ok(job) => job.advice(),
            Err(diagnostics) => diagnostics,
        };
        report::tell(&found, &source.name(), &source.text, args.message_format);
        let errors = found.iter().filter(|diagnostic| diagnostic.is_error()).count();
        if errors > 0 {
            fate = Fate::Refused;
        } else if args.message_format == MessageFormat::Human {
            print(&format!("{}: {}\n", source.name(), summary(found.len())))?;
        }
    }
    fate.done()
}

fn summary(warnings: usize) -> String {
    match warnings {
        0 => "no mistake found".into(),
        1 => "no mistake found, 1 warning".into(),
        many => format!("no mistake found, {many} warnings"),
    }
}
