//! Several replays in parallel, for jobs whose steps are independent.
//!
//! One worker per thread. A batch consists of consecutive runs of steps, one per worker. It is
//! evaluated and its lines are written, in the order of the steps, while the workers replay the
//! next batch.

use rayon::prelude::*;

use super::reader::{BLOCK_EVALUATIONS, StepReader};
use crate::{
    Failure, Job,
    fault::at_step,
    journal::StepResult,
    output::{NotFinite, Outputs, TableLine},
    step::Step,
};

/// Largest number of steps that a worker makes per batch; more would leave the last workers idle
/// at the end of the job.
const WORKER_STEPS: usize = 256;

/// A replay and the steps that it has made.
struct ReplayWorker<'a> {
    reader: StepReader<'a>,
    steps: Vec<Step>,
}

/// The steps of one worker and their lines.
struct WorkerBatch<'a> {
    steps: Vec<Step>,
    outputs: Outputs<'a>,
    lines: Vec<TableLine>,
}

/// Steps that are evaluated together, in their order.
pub(super) struct StepBatch<'a>(Vec<WorkerBatch<'a>>);

/// The workers, in the order of the steps that they hold.
pub(super) struct ParallelReplay<'a> {
    workers: Vec<ReplayWorker<'a>>,
    /// The first step that no worker has made yet.
    next: u64,
    /// Evaluations of a step, about.
    cost: f64,
    /// Steps per worker in the last batch.
    each: usize,
}

impl<'a> ParallelReplay<'a> {
    /// True if the steps behind `reader` are independent, and there are threads for them.
    pub(super) fn are_possible(reader: &StepReader<'a>) -> bool {
        rayon::current_num_threads() > 1 && reader.steps_are_independent()
    }

    /// One worker per thread for the steps behind `reader`, which has read a first block of `count`
    /// steps.
    pub(super) fn after(reader: StepReader<'a>, count: usize, shows: bool) -> Self {
        let (job, threads) = (reader.job, rayon::current_num_threads());
        let worker = |reader| ReplayWorker { reader, steps: Vec::new() };
        let cost = reader.cost / count.max(1) as f64;
        let (control, part, next) = (reader.control, reader.part.clone(), reader.next);
        let mut workers = vec![worker(reader)];
        workers.extend(
            (1..threads).map(|_| worker(StepReader::new(job, control, part.clone(), shows))),
        );
        Self { workers, next, cost, each: count.max(1) }
    }

    /// Replays the next batch: at most `most` steps in total, but at least one per worker. Returns
    /// false if there are none.
    pub(super) fn replay(&mut self, most: usize) -> Result<bool, Failure> {
        let count = self.workers.len();
        let enough = (BLOCK_EVALUATIONS / self.cost.max(1.0)) as usize;
        // Steps may become dearer: so the blocks grow slowly.
        let each = (most.min(enough) / count).clamp(1, WORKER_STEPS.min(2 * self.each));
        self.each = each;
        let starts = (self.next..).step_by(each);
        let replayed: Vec<Result<(), Failure>> = self
            .workers
            .par_iter_mut()
            .zip(starts.take(count).collect::<Vec<_>>())
            .map(|(worker, start)| {
                worker.steps.clear();
                worker.reader.skip_to(start)?;
                worker.reader.add(&mut worker.steps, each, f64::INFINITY)
            })
            .collect();
        replayed.into_iter().collect::<Result<(), Failure>>()?;
        let steps = self.workers.iter().map(|worker| worker.steps.len()).sum::<usize>();
        let cost: f64 = self.workers.iter().map(|worker| worker.reader.cost).sum();
        self.cost = cost / steps.max(1) as f64;
        self.next += steps as u64;
        Ok(steps > 0)
    }

    /// Moves the steps replayed last into `batch`; the memory of its old steps is used again.
    pub(super) fn move_into(&mut self, batch: &mut StepBatch<'a>) {
        for (worker, own) in self.workers.iter_mut().zip(&mut batch.0) {
            std::mem::swap(&mut worker.steps, &mut own.steps);
        }
    }

    /// The number of steps replayed, of all that there were.
    pub(super) fn count(&self) -> u64 {
        self.next
    }
}

impl<'a> StepBatch<'a> {
    /// An empty batch for `workers` workers; `formats` as for [`Outputs::new`].
    pub(super) fn new(job: &'a Job, workers: usize, formats: bool) -> Self {
        let empty = || WorkerBatch {
            steps: Vec::new(),
            outputs: Outputs::new(job, formats),
            lines: Vec::new(),
        };
        Self((0..workers).map(|_| empty()).collect())
    }

    /// The steps.
    pub(super) fn steps(&self) -> impl Iterator<Item = &Step> {
        self.0.iter().flat_map(|own| &own.steps)
    }

    /// Makes the lines of the steps, which came out as `all`.
    pub(super) fn fill(&mut self, all: &[StepResult]) -> Result<(), Failure> {
        let mut rest = all;
        let mut parts = Vec::with_capacity(self.0.len());
        for own in &self.0 {
            let (part, behind) = rest.split_at(own.steps.len());
            parts.push(part);
            rest = behind;
        }
        let filled: Vec<Result<(), Failure>> =
            self.0.par_iter_mut().zip(parts).map(|(own, part)| own.fill(part)).collect();
        filled.into_iter().collect()
    }

    /// The counts of outputs that are not finite, of each worker.
    pub(super) fn not_finite(&self) -> impl Iterator<Item = &NotFinite> {
        self.0.iter().map(|own| &own.outputs.not_finite)
    }

    /// The steps and their lines.
    pub(super) fn lines(&self) -> impl Iterator<Item = (&Step, &TableLine)> {
        self.0.iter().flat_map(|own| own.steps.iter().zip(&own.lines))
    }
}

impl WorkerBatch<'_> {
    fn fill(&mut self, all: &[StepResult]) -> Result<(), Failure> {
        if self.lines.len() < all.len() {
            self.lines.resize_with(all.len(), TableLine::default);
        }
        for ((step, finished), line) in self.steps.iter().zip(all).zip(&mut self.lines) {
            self.outputs
                .fill(line, step, &finished.values)
                .map_err(|fault| at_step(step.index, fault))?;
        }
        Ok(())
    }
}
