//! Running a job: steps in blocks, each block in parallel, results in order.

use std::{
    collections::BTreeSet,
    ops::Range,
    time::{Duration, Instant},
};

use scattering::{Defect, Notice};

use crate::{
    Control, Failure, Job,
    colour::{ColourTable, fold::Fold},
    fault::Fault,
    journal::{Finished, Forgetful, Journal},
    limits::Meter,
    listing,
    output::{Line, Outputs, Sink, Stream, head},
    region::Apertures,
    replay::Replay,
    sampling::Layout,
    share::Shared,
    step::{Evaluated, Integral, Step},
    uncertainty::ErrorColumns,
};

/// Steps that are replayed before they are evaluated together.
const BLOCK_STEPS: usize = 1024;
/// Evaluations after which a block is closed, so that progress is seen and a wish to stop heard.
const BLOCK_EVALUATIONS: f64 = 2e6;

/// A block of a part should take about this long.
const SHORT: Duration = Duration::from_millis(250);
/// Evaluations of an adaptive integral, about; it may be a thousand times more.
const ADAPTIVE_EVALUATIONS: f64 = 2e4;

/// What a finished run has to tell.
#[derive(Debug, Default)]
pub struct Summary {
    /// Steps of the loops.
    pub steps: u64,
    /// Evaluations of the model.
    pub evaluations: f64,
    /// Seconds it took.
    pub seconds: f64,
    /// Defects of NIST's library that a sound run stepped around, limits that it passed.
    pub met: BTreeSet<Notice>,
    /// The colour table, if the program has a section COLOR.
    pub colour: Option<ColourTable>,
}

impl Job {
    /// Runs the job and writes its tables to `sink`.
    ///
    /// # Errors
    ///
    /// What is wrong with a step, a limit that was reached, a wish to stop, a table that cannot
    /// be written. What `sink` has taken until then is not the table of the job.
    pub fn run(&self, sink: &mut dyn Sink, control: &Control) -> Result<Summary, Failure> {
        self.run_on(sink, control, &mut Forgetful)
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
    ) -> Result<Summary, Failure> {
        sink.write(Stream::Listing, &listing::head(self))?;
        sink.write(Stream::Results, &head(self))?;
        if self.samples_name().is_some() {
            sink.write(Stream::Samples, listing::SAMPLES_HEAD)?;
        }
        let mut runner = Runner::new(self, sink, control, journal);
        runner.fold = self.colour.as_ref().map(Fold::new);
        runner.steps()?;
        runner.sink.write(Stream::Listing, &listing::tail(runner.summary.seconds))?;
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
    ) -> Result<Summary, Failure> {
        assert!(!self.in_order, "a part of a job that runs in order");
        let mut forgetful = Forgetful;
        let mut runner = Runner::new(self, sink, control, &mut forgetful);
        runner.part = Some(part);
        runner.pace = 1;
        runner.steps()?;
        Ok(runner.summary)
    }

    /// How many steps the loops have.
    ///
    /// # Errors
    ///
    /// What is wrong with a step, more steps than the limit, a wish to stop.
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

    /// What stands before the first step.
    pub fn head(&self, stream: Stream) -> String {
        match stream {
            Stream::Results => head(self),
            Stream::Listing => listing::head(self),
            Stream::Samples => listing::SAMPLES_HEAD.to_owned(),
        }
    }

    /// What stands behind the last step of a run that took `seconds`.
    pub fn tail(stream: Stream, seconds: f64) -> String {
        if stream == Stream::Listing { listing::tail(seconds) } else { String::new() }
    }

    fn within_limit(&self, steps: u64) -> Result<(), Failure> {
        let limit = self.options.limits.steps;
        if steps > limit {
            return Err(Failure::Limit(format!("the loops have more than {limit} steps")));
        }
        Ok(())
    }
}

struct Runner<'a> {
    job: &'a Job,
    sink: &'a mut dyn Sink,
    control: &'a Control,
    journal: &'a mut dyn Journal,
    meter: Meter<'a>,
    shared: Shared<'a>,
    outputs: Outputs<'a>,
    /// The line that is being written.
    line: Line,
    fold: Option<Fold<'a>>,
    summary: Summary,
    /// The steps to be evaluated, unless all are.
    part: Option<Range<u64>>,
    /// Steps of a block, at most.
    pace: usize,
}

impl<'a> Runner<'a> {
    fn new(
        job: &'a Job,
        sink: &'a mut dyn Sink,
        control: &'a Control,
        journal: &'a mut dyn Journal,
    ) -> Self {
        Self {
            job,
            sink,
            control,
            journal,
            meter: Meter::new(&job.options.limits),
            shared: Shared::new(job, control),
            outputs: Outputs::new(job),
            line: Line::default(),
            fold: None,
            summary: Summary::default(),
            part: None,
            pace: if job.in_order { 1 } else { BLOCK_STEPS },
        }
    }

    /// All blocks; while one is evaluated the next one is replayed.
    fn steps(&mut self) -> Result<(), Failure> {
        let started = Instant::now();
        let mut gather = Gather {
            job: self.job,
            control: self.control,
            replay: Replay::new(self.job),
            part: self.part.clone(),
            steps: 0,
        };
        let mut block = gather.block(self.pace)?;
        let mut done_with = Vec::new();
        while let Some(last) = block.last() {
            let fraction = self.fraction(last);
            let block_started = Instant::now();
            let pace = self.pace;
            let next = if self.job.in_order {
                self.evaluate(&mut block, Some(&mut gather.replay))?;
                gather.block(pace)
            } else {
                let evaluate = || self.evaluate(&mut block, None);
                let (done, next) = rayon::join(evaluate, || {
                    // Memory goes back to the thread that took it.
                    drop(std::mem::take(&mut done_with));
                    gather.block(pace)
                });
                done?;
                next
            };
            self.sink.block_done()?;
            self.control.report(fraction);
            self.keep_pace(block_started.elapsed());
            done_with = std::mem::replace(&mut block, next?);
        }
        self.summary.steps = gather.steps;
        self.summary.seconds = started.elapsed().as_secs_f64();
        self.summary.evaluations = self.meter.evaluations;
        Ok(())
    }

    /// How much is done behind `step`.
    fn fraction(&self, step: &Step) -> f64 {
        self.part.as_ref().map_or(step.fraction, |part| {
            (step.index + 1 - part.start) as f64 / (part.end - part.start) as f64
        })
    }

    /// Keeps the blocks of a part short, for what is in them is lost when the process ends.
    fn keep_pace(&mut self, took: Duration) {
        if self.part.is_none() {
            return;
        }
        if took < SHORT {
            self.pace = BLOCK_STEPS.min(2 * self.pace);
        } else if took > 4 * SHORT {
            self.pace = (self.pace / 2).max(1);
        }
    }

    /// Evaluates a block and writes it. Steps that run in order give their results to `replay`.
    fn evaluate(
        &mut self,
        block: &mut [Step],
        mut replay: Option<&mut Replay<'_>>,
    ) -> Result<(), Failure> {
        let mut all = self.recalled(block)?;
        let known = all.len();
        if self.job.chained
            && let Some(replay) = &mut replay
        {
            self.evaluate_chain(block, &mut all, replay)?;
        } else {
            let new = &block[known..];
            let values = self.shared.evaluate(new, &mut self.meter)?;
            let mut values = values.into_iter();
            for step in new {
                let values = values.by_ref().take(step.integrals.len()).collect();
                all.push(Finished { values, samples: self.samples(step) });
            }
        }
        self.summary.met.extend(self.shared.take_met());
        if block.iter().flat_map(|step| &*step.integrals).any(is_cut_by_nist) {
            self.summary.met.insert(Defect::PolygonHorizon.into());
        }
        if let Some(first) = block.get(known) {
            self.journal.keep(first.index, &all[known..])?;
        }
        for (step, finished) in block.iter().zip(&all) {
            self.write(step, finished)?;
            if let Some(replay) = &mut replay {
                self.outputs.feed_back(&mut replay.scope);
            }
        }
        Ok(())
    }

    /// Writes what `step` has to say: its part of the listing, its line, its samples.
    fn write(&mut self, step: &Step, finished: &Finished) -> Result<(), Failure> {
        if !step.listing.is_empty() {
            self.sink.write(Stream::Listing, &step.listing)?;
        }
        self.outputs
            .fill(&mut self.line, step, &finished.values)
            .map_err(|fault| at_step(step.index, fault))?;
        self.sink.write(Stream::Results, &self.line.text)?;
        self.sink.row(&self.line)?;
        if let Some(fold) = &mut self.fold {
            fold.add(step, &mut self.outputs).map_err(|fault| at_step(step.index, fault))?;
        }
        if !finished.samples.is_empty() {
            self.sink.write(Stream::Samples, &finished.samples)?;
        }
        self.sink.step_done(step.index)?;
        Ok(())
    }

    /// What the journal has of the first steps of `block`.
    fn recalled(&mut self, block: &[Step]) -> Result<Vec<Finished>, Failure> {
        let mut known = Vec::new();
        for step in block {
            match self.journal.recall(step.index)? {
                Some(finished) => known.push(finished),
                None => break,
            }
        }
        Ok(known)
    }

    fn samples(&mut self, step: &Step) -> String {
        match self.job.samples_name() {
            Some(_) => self.shared.samples(step),
            None => String::new(),
        }
    }

    /// Integrals whose apertures read integrals before them, one after the other; the first steps
    /// are in `all`, and so are the others in the end.
    fn evaluate_chain(
        &mut self,
        block: &mut [Step],
        all: &mut Vec<Finished>,
        replay: &mut Replay<'_>,
    ) -> Result<(), Failure> {
        for (at, step) in block.iter_mut().enumerate() {
            let mut values = Vec::new();
            for (number, plan) in self.job.integrals.iter().enumerate() {
                replay.add_integral(step).map_err(|fault| at_step(step.index, fault))?;
                let last = match all.get(at) {
                    Some(finished) => finished.values.get(number),
                    None => {
                        price(self.job, step)?;
                        let only = std::slice::from_ref(&*step);
                        values = self.shared.evaluate(only, &mut self.meter)?;
                        values.last()
                    }
                };
                let last = last.copied().unwrap_or(Evaluated::NONE);
                replay.scope.set(plan.slot, last.value.into());
                let errors = self.job.errors.iter().flat_map(ErrorColumns::all);
                for column in errors.filter(|column| column.integral == number) {
                    replay.scope.set(column.slot, last.error.into());
                }
            }
            if at == all.len() {
                all.push(Finished { values, samples: self.samples(step) });
            }
        }
        Ok(())
    }
}

/// Replays steps until there are enough of them.
struct Gather<'a> {
    job: &'a Job,
    control: &'a Control,
    replay: Replay<'a>,
    /// The steps to be evaluated, unless all are.
    part: Option<Range<u64>>,
    /// Steps replayed so far.
    steps: u64,
}

impl Gather<'_> {
    /// The steps of the next block, at most `most`; empty behind the last step.
    fn block(&mut self, most: usize) -> Result<Vec<Step>, Failure> {
        let mut block = Vec::new();
        let mut cost = 0.0;
        while block.len() < most && cost < BLOCK_EVALUATIONS {
            let index = self.steps;
            if self.part.as_ref().is_some_and(|part| index >= part.end) {
                break;
            }
            let step = self.replay.next_step().map_err(|fault| at_step(index, fault))?;
            let Some(step) = step else { break };
            self.steps += 1;
            self.job.within_limit(self.steps)?;
            if self.part.as_ref().is_some_and(|part| index < part.start) {
                if self.control.is_cancelled() {
                    return Err(Failure::Cancelled);
                }
                continue;
            }
            cost += price(self.job, &step)?;
            block.push(step);
        }
        Ok(block)
    }
}

/// About how many directions the integrals of `step` have.
fn price(job: &Job, step: &Step) -> Result<f64, Failure> {
    let limit = job.options.limits.directions;
    let mut cost = 0.0;
    for (integral, plan) in step.integrals.iter().zip(&job.integrals) {
        if integral.demand.is_some() {
            cost += ADAPTIVE_EVALUATIONS;
            continue;
        }
        let estimate = Layout::estimate(&integral.region, &integral.sampling);
        if estimate > limit {
            return Err(Failure::Limit(format!(
                "{} would have {estimate:.3e} directions, more than {limit:e}: \
                 make differential larger or minsamples and polygonsides smaller",
                plan.name
            )));
        }
        cost += estimate;
    }
    Ok(cost)
}

/// Whether the aperture is the true one of a shape for which NIST's program takes a polygon.
fn is_cut_by_nist(integral: &Integral) -> bool {
    integral.sampling.apertures == Apertures::Exact && integral.region.is_round()
}

/// A fault of the first step is a fault of the program; a later one ends the run.
pub(crate) fn at_step(step: u64, fault: Fault) -> Failure {
    if step == 0 { Failure::Program(vec![*fault]) } else { Failure::Step { step, fault } }
}
