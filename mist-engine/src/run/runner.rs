//! Blocks of steps: replayed, evaluated in parallel, written in order.

use std::{
    ops::Range,
    time::{Duration, Instant},
};

use scattering::{Defect, Mode, notice::keep_largest};

use super::{
    parallel::{ParallelReplay, StepBatch},
    reader::{BLOCK_STEPS, StepReader, price},
    reusable::ReusableSteps,
    summary::RunSummary,
};
use crate::{
    Control, Failure, Job,
    colour::fold::Fold,
    evaluate::Evaluator,
    fault::at_step,
    journal::{Journal, StepResult},
    limits::Meter,
    listing,
    output::{OutputStream, Outputs, Sink, TableLine},
    plan::ErrorColumns,
    replay::Replay,
    step::{Evaluated, Step},
};

/// A block of a part should take about this long.
const SHORT: Duration = Duration::from_millis(250);
/// Steps of the first block of a run whose steps stand alone: it shows what a step costs.
const FIRST_STEPS: usize = 32;

/// A run of a job: it reads steps, evaluates them and writes their lines.
pub(super) struct Runner<'a> {
    job: &'a Job,
    pub(super) sink: &'a mut dyn Sink,
    control: &'a Control,
    journal: &'a mut dyn Journal,
    meter: Meter<'a>,
    shared: Evaluator<'a>,
    outputs: Outputs<'a>,
    /// The line that is being written.
    line: TableLine,
    /// The part of the listing that is being written.
    listing: String,
    pub(super) fold: Option<Fold<'a>>,
    pub(super) summary: RunSummary,
    /// The steps to be evaluated, unless all are.
    pub(super) part: Option<Range<u64>>,
    /// Steps of a block, at most.
    pub(super) pace: usize,
}

impl<'a> Runner<'a> {
    pub(super) fn new(
        job: &'a Job,
        sink: &'a mut dyn Sink,
        control: &'a Control,
        journal: &'a mut dyn Journal,
    ) -> Self {
        let outputs = Outputs::new(job, sink.wants(OutputStream::Results));
        Self {
            job,
            sink,
            control,
            journal,
            meter: Meter::new(&job.options.limits),
            shared: Evaluator::new(job, control),
            outputs,
            line: TableLine::default(),
            listing: String::new(),
            fold: None,
            summary: RunSummary::default(),
            part: None,
            pace: if job.graph.in_order { 1 } else { BLOCK_STEPS },
        }
    }

    /// All blocks.
    pub(super) fn steps(&mut self) -> Result<(), Failure> {
        let started = Instant::now();
        let shows = self.sink.wants_loops() || self.sink.wants(OutputStream::Results);
        let mut reader = StepReader::new(self.job, self.control, self.part.clone(), shows);
        if let Some(part) = &self.part {
            reader.approach(part.start)?;
        }
        let first = reader.block(self.pace.min(FIRST_STEPS))?;
        self.summary.steps = if ParallelReplay::are_possible(&reader) {
            let workers = ParallelReplay::after(reader, first.len(), shows);
            self.run_parallel(first, workers)?
        } else {
            self.run_sequential(first, reader)?
        };
        self.end(started);
        Ok(())
    }

    /// All blocks of the steps of an earlier run.
    pub(super) fn reuse(&mut self, steps: &ReusableSteps) -> Result<(), Failure> {
        let started = Instant::now();
        let shows = self.sink.wants_loops() || self.sink.wants(OutputStream::Results);
        for block in steps.blocks_for(self.job, shows)? {
            let block_started = Instant::now();
            let mut block: Vec<Step> = block.collect();
            self.summary.steps += block.len() as u64;
            let fraction = block.last().map_or(1.0, |last| self.fraction(last));
            self.evaluate(&mut block, None)?;
            self.end_block(fraction, block_started)?;
        }
        self.end(started);
        Ok(())
    }

    /// Completes the summary of a run that began at `started`.
    fn end(&mut self, started: Instant) {
        let steps = self.part.as_ref().map_or(self.summary.steps, |part| part.end - part.start);
        self.summary.warnings.extend(self.outputs.not_finite.warnings(self.job, steps));
        keep_largest(&mut self.summary.met);
        self.summary.seconds = started.elapsed().as_secs_f64();
        self.summary.evaluations = self.meter.evaluations;
        self.summary.warnings.extend(self.shared.warnings());
    }

    /// All blocks of steps that stand alone: while some are evaluated the next ones are replayed;
    /// gives their number.
    fn run_parallel(
        &mut self,
        mut first: Vec<Step>,
        mut workers: ParallelReplay<'a>,
    ) -> Result<u64, Failure> {
        let block_started = Instant::now();
        if let Some(fraction) = first.last().map(|last| self.fraction(last)) {
            self.evaluate(&mut first, None)?;
            self.end_block(fraction, block_started)?;
        }
        let threads = rayon::current_num_threads();
        let mut batch = StepBatch::new(self.job, threads, self.sink.wants(OutputStream::Results));
        let mut goes_on = workers.replay(self.pace.saturating_mul(threads))?;
        while goes_on {
            let block_started = Instant::now();
            workers.move_into(&mut batch);
            let fraction = batch.steps().last().map_or(1.0, |last| self.fraction(last));
            let most = self.pace.saturating_mul(threads);
            let (done, next) = rayon::join(|| self.finish(&mut batch), || workers.replay(most));
            done?;
            self.end_block(fraction, block_started)?;
            goes_on = next?;
        }
        batch.not_finite().for_each(|counts| self.outputs.not_finite.merge(counts));
        Ok(workers.count())
    }

    /// Evaluates a batch and writes it.
    fn finish(&mut self, batch: &mut StepBatch<'a>) -> Result<(), Failure> {
        let steps: Vec<&Step> = batch.steps().collect();
        let all = self.finished(&steps)?;
        if self.fold.is_none() && self.job.graph.lines_independent {
            batch.fill(&all)?;
            for ((step, line), finished) in batch.lines().zip(&all) {
                emit((self.job, self.sink), step, line, finished, &mut self.listing)?;
            }
        } else {
            for (step, finished) in steps.into_iter().zip(&all) {
                self.write(step, finished)?;
            }
        }
        Ok(())
    }

    /// All blocks, the first one at hand; while one is evaluated the next one is replayed. Gives
    /// the number of steps.
    fn run_sequential(
        &mut self,
        first: Vec<Step>,
        mut reader: StepReader<'a>,
    ) -> Result<u64, Failure> {
        let mut block = first;
        let mut done_with = Vec::new();
        while let Some(last) = block.last() {
            let fraction = self.fraction(last);
            let block_started = Instant::now();
            let pace = self.pace;
            let next = if self.job.graph.in_order {
                self.evaluate(&mut block, Some(&mut reader.replay))?;
                reader.block(pace)
            } else {
                let evaluate = || self.evaluate(&mut block, None);
                let (done, next) = rayon::join(evaluate, || {
                    // Memory goes back to the thread that took it.
                    drop(std::mem::take(&mut done_with));
                    reader.block(pace)
                });
                done?;
                next
            };
            self.end_block(fraction, block_started)?;
            done_with = std::mem::replace(&mut block, next?);
        }
        Ok(reader.next)
    }

    /// Tells that a block is written.
    fn end_block(&mut self, fraction: f64, started: Instant) -> Result<(), Failure> {
        self.sink.block_done()?;
        self.control.report(fraction);
        self.keep_pace(started.elapsed());
        Ok(())
    }

    /// Progress after `step`.
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
        let all = match &mut replay {
            Some(replay) if self.job.graph.chained => self.evaluate_chain(block, replay)?,
            _ => self.finished(&block.iter().collect::<Vec<_>>())?,
        };
        for (step, finished) in block.iter().zip(&all) {
            self.write(step, finished)?;
            if let Some(replay) = &mut replay {
                self.outputs.feed_back(replay.values_mut());
            }
        }
        Ok(())
    }

    /// Evaluates a block, except for what the journal has.
    fn finished(&mut self, block: &[&Step]) -> Result<Vec<StepResult>, Failure> {
        let mut all = self.recalled(block.iter().copied())?;
        let known = all.len();
        let new = &block[known..];
        let values = self.shared.evaluate(new, &mut self.meter)?;
        let mut values = values.into_iter();
        for step in new {
            let values = values.by_ref().take(step.integrals.len()).collect();
            all.push(StepResult { values, samples: self.samples(step) });
        }
        self.keep(block.iter().copied(), known, &all)?;
        Ok(all)
    }

    /// Notes what was met and keeps the steps behind the first `known` in the journal.
    fn keep<'s>(
        &mut self,
        mut block: impl Iterator<Item = &'s Step> + Clone,
        known: usize,
        all: &[StepResult],
    ) -> Result<(), Failure> {
        self.summary.met.extend(self.shared.take_met());
        let mut integrals = block.clone().flat_map(|step| &*step.integrals);
        // NIST's program takes polygons for round apertures.
        let is_sound = self.job.options.mode == Mode::Sound;
        if is_sound && integrals.any(|integral| integral.region.is_round()) {
            self.summary.met.insert(Defect::PolygonHorizon.into());
        }
        if let Some(first) = block.nth(known) {
            self.journal.keep(first.index, &all[known..])?;
        }
        Ok(())
    }

    /// Makes the line of `step` and writes it.
    fn write(&mut self, step: &Step, finished: &StepResult) -> Result<(), Failure> {
        self.outputs
            .fill(&mut self.line, step, &finished.values)
            .map_err(|fault| at_step(step.index, fault))?;
        if let Some(fold) = &mut self.fold {
            fold.add(step, &mut self.outputs).map_err(|fault| at_step(step.index, fault))?;
        }
        emit((self.job, self.sink), step, &self.line, finished, &mut self.listing)
    }

    /// Results in the journal for the first steps of `block`.
    fn recalled<'s>(
        &mut self,
        block: impl Iterator<Item = &'s Step>,
    ) -> Result<Vec<StepResult>, Failure> {
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
            Some(_) if self.sink.wants(OutputStream::Samples) => self.shared.samples(step),
            _ => String::new(),
        }
    }

    /// Integrals whose apertures read integrals before them, one after the other.
    fn evaluate_chain(
        &mut self,
        block: &mut [Step],
        replay: &mut Replay<'_>,
    ) -> Result<Vec<StepResult>, Failure> {
        let mut all = self.recalled(block.iter())?;
        let known = all.len();
        for (at, step) in block.iter_mut().enumerate() {
            let mut values = Vec::new();
            for (number, plan) in self.job.plan.integrals.iter().enumerate() {
                replay.add_integral(step).map_err(|fault| at_step(step.index, fault))?;
                let last = match all.get(at) {
                    Some(finished) => finished.values.get(number),
                    None => {
                        price(self.job, step)?;
                        values = self.shared.evaluate(&[step], &mut self.meter)?;
                        values.last()
                    }
                };
                let last = last.copied().unwrap_or(Evaluated::NONE);
                replay.values_mut().set_number(plan.slot, last.value, None);
                let errors = self.job.plan.errors.iter().flat_map(ErrorColumns::all);
                for column in errors.filter(|column| column.integral == number) {
                    replay.values_mut().set_number(column.slot, last.error, None);
                }
            }
            if at == all.len() {
                all.push(StepResult { values: values.into(), samples: self.samples(step) });
            }
        }
        self.keep(block.iter(), known, &all)?;
        Ok(all)
    }
}

/// Writes the part of `step` of the listing, made in `text`, its line and its samples.
fn emit(
    (job, sink): (&Job, &mut dyn Sink),
    step: &Step,
    line: &TableLine,
    finished: &StepResult,
    text: &mut String,
) -> Result<(), Failure> {
    let is_listed = !step.listing.is_empty() && listing::lists(job, step.index);
    if is_listed && sink.wants(OutputStream::Listing) {
        text.clear();
        step.listing.iter().for_each(|line| listing::push_parameter(text, job, line));
        sink.write(OutputStream::Listing, text)?;
    }
    if sink.wants(OutputStream::Results) {
        sink.write(OutputStream::Results, &line.text)?;
    }
    sink.row(line)?;
    if !finished.samples.is_empty() {
        sink.write(OutputStream::Samples, &finished.samples)?;
    }
    sink.step_done(step.index)?;
    Ok(())
}
