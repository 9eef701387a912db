//! `mist key`: a key for the service, and the line by which the service knows it.

use clap::ValueEnum;
use mist_server::keys;

use super::{error::CommandError, input::read_input, output::print, report};

/// Make a key for `mist serve --keys`, or the line for one that you have.
///
/// The line NAME SCOPES DIGEST goes to standard output, a new key to standard error: it is shown
/// once and kept nowhere.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist key farm >> keys
  mist key --scopes read viewer >> keys
  mist key --hash ci < key.txt >> keys
  curl -H \"Authorization: Bearer $KEY\" http://127.0.0.1:8650/v1/materials")]
pub(super) struct KeyArgs {
    /// Name of the client that has the key.
    name: String,
    /// Permissions: read looks at what is there and computes within small limits, run computes
    /// and changes what it has stored, admin changes what others have stored.
    #[arg(long, value_enum, value_delimiter = ',', default_value = "read,run")]
    scopes: Vec<Scopes>,
    /// Take the key from standard input.
    #[arg(long)]
    hash: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum Scopes {
    Read,
    Run,
    Admin,
}

/// Prints the line.
pub(super) fn key(args: &KeyArgs) -> Result<(), CommandError> {
    if args.name.is_empty() || args.name.contains(|c: char| c.is_whitespace() || c == '#') {
        return Err(CommandError::Refused("the name has no blanks and no #".into()));
    }
    let key = if args.hash {
        let key = read_input(None)?.trim().to_owned();
        if key.len() < 32 {
            let message = "the key has less than 32 characters: let `mist key` make one";
            return Err(CommandError::Refused(message.into()));
        }
        key
    } else {
        let made = keys::random().map_err(|error| CommandError::Failed(error.to_string()))?;
        report::print_line(&made);
        made
    };
    let scopes: Vec<&str> = args
        .scopes
        .iter()
        .map(|scope| match scope {
            Scopes::Read => "read",
            Scopes::Run => "run",
            Scopes::Admin => "admin",
        })
        .collect();
    print(&(keys::line(&args.name, &scopes.join(","), &key) + "\n"))
}
