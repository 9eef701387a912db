//! `mist man`: manual pages for `man`.

use std::{fs, path::PathBuf};

use clap::Command;

use super::{error::CommandError, output::print};

/// Write the manual pages mist.1, mist-run.1, … into a folder.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist man ~/.local/share/man/man1
  mist man pages && man pages/mist-run.1")]
pub(super) struct ManArgs {
    /// The folder; it is created if it is not there.
    folder: PathBuf,
}

/// Writes the pages of `program` and of its commands.
pub(super) fn man(args: &ManArgs, program: Command) -> Result<(), CommandError> {
    let folder = &args.folder;
    let count = program.get_subcommands().count() + 1;
    fs::create_dir_all(folder).and_then(|()| clap_mangen::generate_to(program, folder)).map_err(
        |error| CommandError::Failed(format!("cannot write into {}: {error}", folder.display())),
    )?;
    print(&format!("{count} manual pages in {}\n", folder.display()))
}
