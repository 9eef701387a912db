//! The service from its start to its end: sockets, threads, and signals.

use std::{io, net::SocketAddr, path::PathBuf};

use crate::{
    AccessOptions, ServeLimits,
    http::{self, App, StartError},
};

/// Options of the service.
#[derive(Clone, Debug)]
pub struct ServeOptions {
    /// Address and port.
    pub listen: SocketAddr,
    /// Folder in which materials and jobs outlive the service; memory if there is none.
    pub data: Option<PathBuf>,
    /// Text of a file of keys; everybody may do everything if there is none.
    pub keys: Option<String>,
    /// Hosts, web pages and addresses that may use the service.
    pub access: AccessOptions,
    /// Bounds for clients.
    pub limits: ServeLimits,
}

/// The reason why the service did not start, or ended before a signal.
#[derive(Debug, thiserror::Error)]
pub enum ServeError {
    /// It cannot start.
    #[error(transparent)]
    Start(#[from] StartError),
    /// A listener beyond loopback without keys and without `--open`.
    #[error(
        "{0} can be reached from other machines: give --keys FILE (see `mist key`), or --open if \
         everybody may use the service"
    )]
    Exposed(SocketAddr),
    /// The address cannot be used.
    #[error("{address}: {source}")]
    Socket {
        /// The address.
        address: SocketAddr,
        /// The reason.
        source: io::Error,
    },
}

/// Answers until the process gets SIGINT or SIGTERM; calls `listening` with the address once
/// connections are accepted.
///
/// # Errors
///
/// If the store or the keys cannot be read, or the address cannot be used or is open to everybody.
pub fn serve(options: &ServeOptions, listening: impl FnOnce(SocketAddr)) -> Result<(), ServeError> {
    let ServeOptions { listen, data, keys, access, limits } = options;
    if access.is_exposed(listen, keys.is_some()) {
        return Err(ServeError::Exposed(*listen));
    }
    let mut access = access.clone();
    access.hosts.push(listen.ip().to_string());
    let failed = |source: io::Error| ServeError::Socket { address: *listen, source };
    let mut limits = limits.clone();
    if access.trust_forwarded_for {
        limits.max_client_connections = limits.max_connections;
    }
    let app = App::new(limits.clone(), data.as_deref(), keys.as_deref())?.with_access(access);
    let runtime = tokio::runtime::Runtime::new().map_err(failed)?;
    let served = runtime.block_on(async {
        let listener = tokio::net::TcpListener::bind(listen).await.map_err(failed)?;
        listening(listener.local_addr().map_err(failed)?);
        let stop = async {
            // Without a signal handler the process ends at once.
            let _ = stop_signal().await;
            app.leave();
        };
        http::serve(listener, http::router(app.clone()), &limits, stop).await.map_err(failed)
    });
    app.stop();
    served
}

/// Waits for SIGINT or SIGTERM.
///
/// # Errors
///
/// If the system has no signal handlers.
async fn stop_signal() -> io::Result<()> {
    #[cfg(unix)]
    {
        use tokio::signal::unix::{SignalKind, signal};
        let mut terminate = signal(SignalKind::terminate())?;
        tokio::select! {
            done = tokio::signal::ctrl_c() => done,
            _ = terminate.recv() => Ok(()),
        }
    }
    #[cfg(not(unix))]
    tokio::signal::ctrl_c().await
}
