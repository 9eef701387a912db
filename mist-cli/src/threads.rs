//! Threads of a command, and long work on them with a bar on the terminal that can be cancelled.

use mist_engine::Control;

use super::{
    error::{CommandError, ExitStatus},
    interrupt,
    progress::TerminalProgress,
    report,
};

/// The flag `--threads`.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(super) struct ThreadsFlag {
    /// Threads [default: one per processor]; results do not depend on it.
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
}

impl ThreadsFlag {
    /// The pool of threads.
    ///
    /// # Errors
    ///
    /// For 0 threads, or if the system starts none.
    pub(super) fn pool(self) -> Result<rayon::ThreadPool, CommandError> {
        if self.threads == Some(0) {
            return Err(CommandError::Refused("--threads must be 1 or more".into()));
        }
        pool(self.threads.unwrap_or(0))
    }

    /// Does `work` on the threads, with a bar called `label`; SIGINT and SIGTERM cancel it.
    ///
    /// # Errors
    ///
    /// As [`ThreadsFlag::pool`].
    pub(super) fn run<T: Send>(
        self,
        label: &str,
        work: impl FnOnce(&Control) -> T + Send,
    ) -> Result<T, CommandError> {
        let pool = self.pool()?;
        let progress = TerminalProgress::new(label);
        let bar = progress.clone();
        let control = Control {
            cancel: interrupt::flag(),
            progress: Some(Box::new(move |part| bar.set(part))),
        };
        let done = pool.install(|| work(&control));
        progress.finish();
        if control.is_cancelled() {
            report::print_line("interrupted: no unfinished file is left");
            return Err(CommandError::Reported(ExitStatus::Interrupted));
        }
        Ok(done)
    }
}

/// A pool of `count` threads; 0 is one per processor.
pub(super) fn pool(count: usize) -> Result<rayon::ThreadPool, CommandError> {
    let builder = rayon::ThreadPoolBuilder::new().num_threads(count);
    builder.build().map_err(|error| CommandError::Failed(format!("cannot start threads: {error}")))
}
