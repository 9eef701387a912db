//! Connections: their number, the time for which they may be silent, and their end.

use std::{
    collections::BTreeMap,
    future::Future,
    io,
    net::IpAddr,
    pin::pin,
    sync::{Arc, Mutex, PoisonError},
    time::Duration,
};

use axum::{Router, extract::ConnectInfo, http::Request};
use hyper::{body::Incoming, server::conn::http1, service::service_fn};
use hyper_util::{
    rt::{TokioIo, TokioTimer},
    server::graceful::GracefulShutdown,
};
use tokio::{net::TcpListener, sync::Semaphore};
use tokio_io_timeout::TimeoutStream;
use tower::ServiceExt;

use crate::limits::ServeLimits;

/// Time for answers that were begun when the service stops.
const DRAIN_TIMEOUT: Duration = Duration::from_secs(10);
/// Pause after the system has refused a connection.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);

/// The address of the other end of a connection.
#[derive(Clone, Copy, Debug)]
pub(super) struct PeerAddress(pub(super) IpAddr);

/// Numbers of open connections by address.
type AddressCounts = Arc<Mutex<BTreeMap<IpAddr, usize>>>;

/// An open connection of an address.
struct AddressPlace(AddressCounts, IpAddr);

impl AddressPlace {
    /// Counts a connection; none if the address has too many.
    fn take(counts: &AddressCounts, address: IpAddr, limits: &ServeLimits) -> Option<Self> {
        let mut all = counts.lock().unwrap_or_else(PoisonError::into_inner);
        let count = all.entry(address).or_insert(0);
        if *count >= limits.max_client_connections.max(1) {
            return None;
        }
        *count += 1;
        Some(Self(counts.clone(), address))
    }
}

impl Drop for AddressPlace {
    fn drop(&mut self) {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(count) = all.get_mut(&self.1) {
            *count -= 1;
            if *count == 0 {
                all.remove(&self.1);
            }
        }
    }
}

/// Answers on `listener` until `stop` is there; then no more connections are accepted, and what
/// was begun is answered.
///
/// # Errors
///
/// If the address of the listener cannot be used at all.
pub async fn serve(
    listener: TcpListener,
    router: Router,
    limits: &ServeLimits,
    stop: impl Future<Output = ()>,
) -> io::Result<()> {
    let places = Arc::new(Semaphore::new(limits.max_connections.max(1)));
    let addresses = Arc::new(Mutex::new(BTreeMap::new()));
    let connections = GracefulShutdown::new();
    let mut http = http1::Builder::new();
    http.timer(TokioTimer::new()).header_read_timeout(limits.silence());
    let silence = limits.silence();
    let mut stop = pin!(stop);
    loop {
        let accept = async {
            let place = places.clone().acquire_owned().await;
            (place, listener.accept().await)
        };
        let (place, accepted) = tokio::select! {
            accepted = accept => accepted,
            () = &mut stop => break,
        };
        let (stream, address) = match accepted {
            Ok(accepted) => accepted,
            Err(error) => {
                tracing::warn!(%error, "a connection was not accepted");
                tokio::time::sleep(ACCEPT_PAUSE).await;
                continue;
            }
        };
        let Some(own_place) = AddressPlace::take(&addresses, address.ip(), limits) else {
            tracing::warn!(%address, "this address has too many connections (--max-client-connections)");
            continue;
        };
        // Answers are whole when they are written: nothing is gained by waiting for more.
        let _ = stream.set_nodelay(true);
        let (router, peer) = (router.clone(), ConnectInfo(PeerAddress(address.ip())));
        let service = service_fn(move |mut request: Request<Incoming>| {
            request.extensions_mut().insert(peer);
            router.clone().oneshot(request)
        });
        // Reading needs no time limit here: heads and bodies have theirs.
        let mut stream = TimeoutStream::new(stream);
        stream.set_write_timeout(Some(silence));
        let connection = http.serve_connection(TokioIo::new(Box::pin(stream)), service);
        let connection = connections.watch(connection);
        tokio::spawn(async move {
            let _places = (place, own_place);
            if let Err(error) = connection.await {
                tracing::debug!(%error, "a connection broke");
            }
        });
    }
    drop(listener);
    if tokio::time::timeout(DRAIN_TIMEOUT, connections.shutdown()).await.is_err() {
        tracing::warn!("some answers were not finished in time");
    }
    Ok(())
}
