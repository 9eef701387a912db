//! Ctrl-C and SIGTERM stop the work in order: temporary files go, nothing half-written stays.

use std::{
    io,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

/// Exit code of a process that was asked twice: that of a shell for Ctrl-C.
const STOPPED_AT_ONCE: i32 = 130;

/// Waits until the process is asked to stop.
///
/// # Errors
///
/// If the system does not tell.
pub(crate) async fn asked() -> io::Result<()> {
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

/// A flag that becomes true when the process is asked to stop; a second time it stops at once.
pub(crate) fn flag() -> Arc<AtomicBool> {
    let flag = Arc::new(AtomicBool::new(false));
    let raised = flag.clone();
    std::thread::spawn(move || {
        let Ok(runtime) = tokio::runtime::Builder::new_current_thread().enable_io().build() else {
            return;
        };
        runtime.block_on(async {
            if asked().await.is_ok() {
                raised.store(true, Ordering::Relaxed);
            }
            if asked().await.is_ok() {
                std::process::exit(STOPPED_AT_ONCE);
            }
        });
    });
    flag
}
