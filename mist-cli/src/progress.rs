//! TerminalProgress on a terminal; silence elsewhere.

use std::{
    io::IsTerminal,
    sync::atomic::{AtomicBool, Ordering},
    time::Duration,
};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Steps of a bar: finer than any terminal shows.
const STEPS: u64 = 10_000;

/// True if the command is quiet.
static IS_QUIET: AtomicBool = AtomicBool::new(false);

/// Lets the command show no progress.
pub(crate) fn be_quiet() {
    IS_QUIET.store(true, Ordering::Relaxed);
}

/// True if the command is quiet.
pub(crate) fn is_quiet() -> bool {
    IS_QUIET.load(Ordering::Relaxed)
}

/// The progress of one run.
#[derive(Clone, Debug)]
pub(crate) struct TerminalProgress {
    bar: ProgressBar,
}

impl TerminalProgress {
    /// A bar with `label` before it, drawn on standard error if that is a terminal and the command is
    /// not quiet.
    pub(crate) fn new(label: &str) -> Self {
        let target = match std::io::stderr().is_terminal() && !is_quiet() {
            true => ProgressDrawTarget::stderr_with_hz(5),
            false => ProgressDrawTarget::hidden(),
        };
        let bar = ProgressBar::with_draw_target(Some(STEPS), target);
        let style = ProgressStyle::with_template("{prefix} {wide_bar} {percent:>3}% {eta:>4}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("━╸ "));
        bar.set_prefix(label.to_owned());
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_millis(500));
        }
        Self { bar }
    }

    /// Shows the part done, from 0 to 1.
    pub(crate) fn set(&self, part: f64) {
        // In range by the clamp.
        self.bar.set_position((part.clamp(0.0, 1.0) * STEPS as f64) as u64);
    }

    /// Shows the bar with `label` before it.
    pub(crate) fn show(&self, label: &str) {
        self.bar.set_prefix(label.to_owned());
    }

    /// Takes the bar away until it is set again, so that lines can be printed.
    pub(crate) fn hide(&self) {
        self.bar.suspend(|| ());
        if !self.bar.is_hidden() {
            self.bar.set_draw_target(ProgressDrawTarget::hidden());
            self.bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(5));
        }
    }

    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}
