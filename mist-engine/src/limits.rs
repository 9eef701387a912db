//! Limits of a run, its progress and its cancellation.

use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::{Duration, Instant},
};

/// Upper bounds of a run; what exceeds them is refused or ended with a reason.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// Evaluations of the model, all steps together.
    pub evaluations: f64,
    /// Directions of one integral: they are held in memory.
    pub directions: f64,
    /// Steps of the loops.
    pub steps: u64,
    /// Wall-clock time.
    pub time: Option<Duration>,
}

impl Default for Limits {
    /// 10¹² evaluations, 3·10⁷ directions in one integral, 10⁹ steps, any time.
    fn default() -> Self {
        Self { evaluations: 1e12, directions: 3e7, steps: 1_000_000_000, time: None }
    }
}

/// Reports how much of a run is done, from 0 to 1.
pub(crate) type Progress = Box<dyn Fn(f64) + Send + Sync>;

/// Control of a run from outside: cancellation and progress.
#[derive(Default)]
pub struct Control {
    /// Set to true to stop the run.
    pub cancel: Arc<AtomicBool>,
    /// Called after every block of steps with the fraction done.
    pub progress: Option<Progress>,
}

impl Control {
    /// True if the run was asked to stop.
    pub fn is_cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    /// Tells that `fraction` of the run is done.
    pub fn report(&self, fraction: f64) {
        if let Some(progress) = &self.progress {
            progress(fraction.clamp(0.0, 1.0));
        }
    }
}

/// Usage of the limits of a run.
pub(crate) struct Meter<'a> {
    limits: &'a Limits,
    started: Instant,
    /// Evaluations so far.
    pub(crate) evaluations: f64,
}

impl<'a> Meter<'a> {
    pub(crate) fn new(limits: &'a Limits) -> Self {
        Self { limits, started: Instant::now(), evaluations: 0.0 }
    }

    /// Adds `count` evaluations, or says which limit they break.
    pub(crate) fn add(&mut self, count: f64) -> Result<(), String> {
        self.evaluations += count;
        if self.evaluations > self.limits.evaluations {
            let limit = self.limits.evaluations;
            return Err(format!("the run needs more than {limit:e} evaluations of the model"));
        }
        match self.limits.time {
            Some(limit) if self.started.elapsed() > limit => {
                Err(format!("the run takes longer than {} s", limit.as_secs_f64()))
            }
            _ => Ok(()),
        }
    }
}
