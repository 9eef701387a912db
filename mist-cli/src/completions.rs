//! `mist completions`: completion of commands and flags in a shell.

use clap::Command;
use clap_complete::{Shell, generate};

use super::{error::CommandError, output::print};

/// Print completions for a shell.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist completions bash > ~/.local/share/bash-completion/completions/mist
  mist completions zsh > ~/.zfunc/_mist            a folder of $fpath
  mist completions fish > ~/.config/fish/completions/mist.fish")]
pub(super) struct CompletionsArgs {
    /// The shell.
    shell: Shell,
}

/// Prints the completions of `program`.
pub(super) fn completions(
    args: &CompletionsArgs,
    mut program: Command,
) -> Result<(), CommandError> {
    let mut script = Vec::new();
    generate(args.shell, &mut program, "mist", &mut script);
    print(&String::from_utf8_lossy(&script))
}
