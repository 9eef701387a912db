//! `mist serve`: tables over HTTP.

use std::net::SocketAddr;

use super::stop::Stop;
use crate::{http, interrupt, report};

/// Answer renderers over HTTP.
///
/// PUT /v1/materials/NAME keeps a material, GET /v1/materials/NAME/table.mtab?… answers with its
/// colour table. There is no encryption: put a proxy in front for anything but this machine.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist serve
  mist serve --listen 127.0.0.1:9000
  curl -X PUT --data-binary @paint.json http://127.0.0.1:8650/v1/materials/paint
  curl 'http://127.0.0.1:8650/v1/materials/paint/table.mtab?thetai=0:15:75&thetas=0:15:75&phis=0:30:180&lambda=400:20:700'")]
pub(super) struct Args {
    /// Address and port.
    #[arg(long, default_value = "127.0.0.1:8650")]
    listen: SocketAddr,
}

/// Answers until it is interrupted.
pub(super) fn serve(args: &Args) -> Result<(), Stop> {
    let failed = |error: std::io::Error| Stop::Failed(format!("{}: {error}", args.listen));
    let runtime = tokio::runtime::Runtime::new().map_err(failed)?;
    runtime.block_on(async {
        let listener = tokio::net::TcpListener::bind(args.listen).await.map_err(failed)?;
        let address = listener.local_addr().map_err(failed)?;
        report::say(&format!("listening on http://{address}"));
        axum::serve(listener, http::router(http::App::default()))
            .with_graceful_shutdown(async {
                // Without a signal handler the process ends at once, which is what was wished.
                let _ = interrupt::asked().await;
            })
            .await
            .map_err(failed)
    })
}
