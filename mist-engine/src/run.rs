//! Running a job: steps in blocks, each block in parallel, results in order.

mod parallel;
mod reader;
mod reusable;
mod runner;
mod summary;

use std::ops::Range;

pub(crate) use reusable::ReusableSteps;
use runner::Runner;
pub use summary::RunSummary;

use crate::{
    Control, Failure, Job,
    colour::fold::Fold,
    fault::at_step,
    journal::{Journal, NoJournal},
    listing,
    output::{OutputStream, Sink, head},
    replay::Replay,
};

impl Job {
    /// Runs the job and writes its tables to `sink`.
    ///
    /// # Errors
    ///
    /// An error in a step, a limit that was reached, a cancellation, a table that cannot
    /// be written. What `sink` has taken until then is not the table of the job.
    pub fn run(&self, sink: &mut dyn Sink, control: &Control) -> Result<RunSummary, Failure> {
        self.run_on(sink, control, &mut NoJournal)
    }

    /// Runs the job and keeps its steps in `journal`; those that the journal has are not
    /// evaluated again. The texts are the same to the last bit, but for the time in the listing.
    ///
    /// # Errors
    ///
    /// As [`Job::run`], and if the journal cannot be read or written.
    pub fn run_on(
        &self,
        sink: &mut dyn Sink,
        control: &Control,
        journal: &mut dyn Journal,
    ) -> Result<RunSummary, Failure> {
        self.run_by(|runner| runner.steps(), sink, control, journal)
    }

    /// [`Job::run`] with the steps of an earlier run.
    ///
    /// # Errors
    ///
    /// As [`Job::run`].
    pub(crate) fn run_again(
        &self,
        steps: &ReusableSteps,
        sink: &mut dyn Sink,
        control: &Control,
    ) -> Result<RunSummary, Failure> {
        self.run_by(|runner| runner.reuse(steps), sink, control, &mut NoJournal)
    }

    /// [`Job::run_on`]; `evaluate` evaluates and writes the steps.
    fn run_by(
        &self,
        evaluate: impl FnOnce(&mut Runner<'_>) -> Result<(), Failure>,
        sink: &mut dyn Sink,
        control: &Control,
        journal: &mut dyn Journal,
    ) -> Result<RunSummary, Failure> {
        for stream in [OutputStream::Listing, OutputStream::Results, OutputStream::Samples] {
            let is_made = stream != OutputStream::Samples || self.samples_name().is_some();
            if is_made && sink.wants(stream) {
                sink.write(stream, &self.head(stream))?;
            }
        }
        let mut runner = Runner::new(self, sink, control, journal);
        let colour = self.plan.colour.as_ref();
        runner.fold = colour.map(|section| Fold::new(section, self.initial_incident()));
        evaluate(&mut runner)?;
        if runner.sink.wants(OutputStream::Listing) {
            let tail = listing::tail(runner.summary.seconds);
            runner.sink.write(OutputStream::Listing, &tail)?;
        }
        let Runner { fold, mut summary, .. } = runner;
        if let Some(fold) = fold {
            let table = fold.table().map_err(|fault| Failure::Program(vec![*fault]))?;
            summary.colour = Some(table);
        }
        Ok(summary)
    }

    /// Runs the steps `part` and writes their lines to `sink`, without what stands before the
    /// first and behind the last step of the job ([`Job::head`], [`Job::tail`]) and without
    /// colours. The lines of all parts, one after the other, are those of [`Job::run`].
    ///
    /// # Errors
    ///
    /// As for [`Job::run`].
    ///
    /// # Panics
    ///
    /// If the steps of the job must run in order.
    pub fn run_part(
        &self,
        part: Range<u64>,
        sink: &mut dyn Sink,
        control: &Control,
    ) -> Result<RunSummary, Failure> {
        assert!(!self.graph.in_order, "a part of a job that runs in order");
        let mut forgetful = NoJournal;
        let mut runner = Runner::new(self, sink, control, &mut forgetful);
        runner.part = Some(part);
        runner.pace = 1;
        runner.steps()?;
        Ok(runner.summary)
    }

    /// Number of steps of the loops.
    ///
    /// # Errors
    ///
    /// An error in a step, more steps than the limit, a cancellation.
    pub fn count_steps(&self, control: &Control) -> Result<u64, Failure> {
        let mut replay = Replay::new(self);
        let mut steps = 0;
        while replay.next_step().map_err(|fault| at_step(steps, fault))?.is_some() {
            steps += 1;
            self.within_limit(steps)?;
            if control.is_cancelled() {
                return Err(Failure::Cancelled);
            }
        }
        Ok(steps)
    }

    /// Text before the first step.
    pub fn head(&self, stream: OutputStream) -> String {
        match stream {
            OutputStream::Results => head(self),
            OutputStream::Listing => listing::head(self),
            OutputStream::Samples => listing::SAMPLES_HEAD.to_owned(),
        }
    }

    /// Text after the last step of a run that took `seconds`.
    pub fn tail(stream: OutputStream, seconds: f64) -> String {
        if stream == OutputStream::Listing { listing::tail(seconds) } else { String::new() }
    }

    fn within_limit(&self, steps: u64) -> Result<(), Failure> {
        let limit = self.options.limits.steps;
        if steps > limit {
            return Err(Failure::Limit(format!("the loops have more than {limit} steps")));
        }
        Ok(())
    }
}
