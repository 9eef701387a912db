//! `mist serve`: the service over HTTP.

use std::{io::IsTerminal, net::SocketAddr, path::PathBuf};

use super::{print, source::Source, stop::Stop};
use crate::{
    ServeLimits, http, interrupt,
    report::{self, MessageFormat},
};

/// Answer renderers over HTTP.
///
/// PUT /v1/materials/NAME keeps a material, GET /v1/materials/NAME/table.mtab?… answers with its
/// colour table, POST /v1/jobs runs a program; /openapi.json describes everything. There is no
/// encryption: put a proxy in front for anything but this machine.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist serve
  mist serve --listen 127.0.0.1:9000 --data /var/lib/mist --keys /etc/mist/keys
  curl -X PUT --data-binary @paint.json http://127.0.0.1:8650/v1/materials/paint
  curl 'http://127.0.0.1:8650/v1/materials/paint/table.mtab?thetai=0:15:75&thetas=0:15:75&phis=0:30:180&lambda=400:20:700'")]
pub(super) struct Args {
    /// Address and port.
    #[arg(long, default_value = "127.0.0.1:8650")]
    listen: SocketAddr,
    /// Folder in which materials and jobs outlive the service [default: memory].
    #[arg(long, value_name = "DIR")]
    data: Option<PathBuf>,
    /// File of keys, lines of `mist key`; without it everybody may do everything.
    #[arg(long, value_name = "FILE")]
    keys: Option<PathBuf>,
    /// How the log on standard error is written.
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    log_format: MessageFormat,
    /// Log every request, and not only what goes wrong.
    #[arg(long)]
    log_requests: bool,
    /// Print the OpenAPI document and end.
    #[arg(long)]
    openapi: bool,
    #[command(flatten)]
    limits: ServeLimits,
}

/// Answers until it is interrupted.
pub(super) fn serve(args: &Args) -> Result<(), Stop> {
    if args.openapi {
        return print(&http::openapi());
    }
    start_log(args);
    let failed = |error: std::io::Error| Stop::Failed(format!("{}: {error}", args.listen));
    let keys = args.keys.as_deref().map(Source::read).transpose()?;
    let app = http::App::new(
        args.limits.clone(),
        args.data.as_deref(),
        keys.as_ref().map(|source| source.text.as_str()),
    );
    let app = app.map_err(|error| Stop::Failed(error.to_string()))?;
    let runtime = tokio::runtime::Runtime::new().map_err(failed)?;
    let served = runtime.block_on(async {
        let listener = tokio::net::TcpListener::bind(args.listen).await.map_err(failed)?;
        let address = listener.local_addr().map_err(failed)?;
        report::say(&format!("listening on http://{address}"));
        let stop = async {
            // Without a signal handler the process ends at once, which is what was wished.
            let _ = interrupt::asked().await;
            app.leave();
        };
        http::serve(listener, http::router(app.clone()), &args.limits, stop).await.map_err(failed)
    });
    app.stop();
    served
}

/// The log goes to standard error: lines for people, or a JSON object per line.
fn start_log(args: &Args) {
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
