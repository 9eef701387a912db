//! Long work with a bar on the terminal, on as many threads as were asked for, that can be stopped.

use mist_engine::Control;

use super::{run::pool, stop::Stop};
use crate::{interrupt, progress::Progress};

/// Does `work` on `threads` threads (one per processor by default), with a bar called `label`.
///
/// # Errors
///
/// If the threads cannot be had.
pub(super) fn watched<T: Send>(
    threads: Option<usize>,
    label: &str,
    work: impl FnOnce(&Control) -> T + Send,
) -> Result<T, Stop> {
    let pool = pool(threads)?;
    let progress = Progress::new(label);
    let bar = progress.clone();
    let control =
        Control { cancel: interrupt::flag(), progress: Some(Box::new(move |part| bar.set(part))) };
    let done = pool.install(|| work(&control));
    progress.finish();
    Ok(done)
}
