//! `mist merge`: the shards of a run become its table.

use std::{fmt::Write as _, path::PathBuf};

use mist_runner::merge;

use super::{error::CommandError, output::print};

/// Put the shards of a run together: the table is that of one run, byte by byte.
///
/// The listing and the samples, if the program has any, are written beside the table under the
/// names that the program gives them.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist merge paint.*-of-4 -o paint.dat
  mist run --shard 1/2 paint.mist && mist run --shard 2/2 paint.mist && mist merge paint.*-of-2")]
pub(super) struct MergeArgs {
    /// All shards of one run, in any order.
    #[arg(required = true)]
    shards: Vec<PathBuf>,
    /// The table [default: the name that the program gives it].
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Writes table, listing and samples.
pub(super) fn merge(args: &MergeArgs) -> Result<(), CommandError> {
    let merged = merge::merge(&args.shards, args.output.as_deref()).map_err(|error| {
        let message = error.to_string();
        if error.is_refusal() {
            CommandError::Refused(message)
        } else {
            CommandError::Failed(message)
        }
    })?;
    let mut said = format!("{}: {} steps\n", merged.job, merged.steps);
    for file in &merged.files {
        // Writing to a string cannot fail.
        let _ = writeln!(said, "  {:<14} {}", file.title, file.path.display());
    }
    print(&said)
}
