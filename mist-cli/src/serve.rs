//! `mist serve`: the service over HTTP.

use std::{io::IsTerminal, net::SocketAddr, path::PathBuf};

use mist_server::{AccessOptions, ServeLimits, ServeOptions, http};

use super::{
    error::CommandError,
    input::InputText,
    output::print,
    report::{self, MessageFormat},
};

/// Answer renderers over HTTP.
///
/// PUT /v1/materials/NAME keeps a material, GET /v1/materials/NAME/table.mtab?… answers with its
/// colour table, POST /v1/jobs runs a program; /openapi.json describes everything. There is no
/// encryption: put a proxy in front for anything but this machine. Web pages of other origins are
/// refused unless --cors names them.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist serve
  mist serve --listen 127.0.0.1:9000 --data /var/lib/mist --keys /etc/mist/keys
  curl -X PUT -H 'Content-Type: application/json' --data-binary @paint.json \
    http://127.0.0.1:8650/v1/materials/paint
  curl 'http://127.0.0.1:8650/v1/materials/paint/table.mtab?thetai=0:15:75&thetas=0:15:75&phis=0:30:180&lambda=400:20:700'")]
pub(super) struct ServeArgs {
    /// Address and port.
    #[arg(long, default_value = "127.0.0.1:8650")]
    listen: SocketAddr,
    /// Folder in which materials and jobs outlive the service [default: memory].
    #[arg(long, value_name = "DIR")]
    data: Option<PathBuf>,
    /// File of keys, lines of `mist key`; without it every client may do everything.
    #[arg(long, value_name = "FILE")]
    keys: Option<PathBuf>,
    /// Form of the log on standard error.
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    log_format: MessageFormat,
    /// Log every request, and not only what goes wrong.
    #[arg(long)]
    log_requests: bool,
    /// Print the OpenAPI document and end.
    #[arg(long)]
    openapi: bool,
    #[command(flatten)]
    access: AccessOptions,
    #[command(flatten)]
    limits: ServeLimits,
}

/// Answers until it is interrupted.
pub(super) fn serve(args: &ServeArgs) -> Result<(), CommandError> {
    if args.openapi {
        return print(&http::openapi());
    }
    start_log(args);
    let keys = args.keys.as_deref().map(InputText::read).transpose()?;
    let options = ServeOptions {
        listen: args.listen,
        data: args.data.clone(),
        keys: keys.map(|source| source.text),
        access: args.access.clone(),
        limits: args.limits.clone(),
    };
    mist_server::serve(&options, |address| {
        report::print_line(&format!("listening on http://{address}"))
    })
    .map_err(|error| CommandError::Failed(error.to_string()))
}

/// The log goes to standard error: lines for people, or a JSON object per line.
fn start_log(args: &ServeArgs) {
    let most = if args.log_requests { tracing::Level::INFO } else { tracing::Level::WARN };
    let log = tracing_subscriber::fmt()
        .with_writer(std::io::stderr)
        .with_max_level(most)
        .with_target(false)
        .with_ansi(std::io::stderr().is_terminal());
    match args.log_format {
        MessageFormat::Human => log.init(),
        MessageFormat::Json => log.json().init(),
    }
}
