//! `mist check`: everything that is wrong with programs, without running them.

use std::path::PathBuf;

use super::{
    error::{CommandError, ExitStatus},
    flags::{CompatFlag, EngineFlags, MessageFlag},
    output::print,
    program::ProgramInput,
    report::MessageFormat,
    reporter::Reporter,
};

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
    #[command(flatten)]
    compat: CompatFlag,
    #[command(flatten)]
    message: MessageFlag,
}

/// Checks the programs.
pub(super) fn check(args: &CheckArgs, reporter: &Reporter) -> Result<(), CommandError> {
    let mut status = ExitStatus::Success;
    for path in &args.programs {
        let program = ProgramInput::read(path)?;
        let source = &program.source;
        let flags = EngineFlags { compat: args.compat, seed: None };
        let found = match program.compile(&program.options(flags, None)) {
            Ok(job) => job.advice(),
            Err(diagnostics) => diagnostics,
        };
        reporter.diagnostics(&found, source, args.message.message_format);
        let errors = found.iter().filter(|diagnostic| diagnostic.is_error()).count();
        if errors > 0 {
            status = ExitStatus::Refused;
        } else if args.message.message_format == MessageFormat::Human {
            print(&format!("{}: {}\n", source.name(), summary(found.len())))?;
        }
    }
    status.into_result()
}

fn summary(warnings: usize) -> String {
    match warnings {
        0 => "no mistake found".into(),
        1 => "no mistake found, 1 warning".into(),
        many => format!("no mistake found, {many} warnings"),
    }
}
