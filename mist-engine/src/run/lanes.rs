//! Several replays side by side, for jobs whose steps stand alone.
//!
//! Each lane replays every n-th stretch of steps. The stretches of all lanes are a round: it is
//! evaluated and its lines are written, in the order of the steps, while the lanes replay the next
//! one.

use rayon::prelude::*;

use super::{BLOCK_EVALUATIONS, Gather, at_step};
use crate::{
    Failure, Job,
    journal::Finished,
    output::{Line, Outputs},
    replay::alone::Alone,
    step::Step,
};

/// Steps that a lane makes at a time, at most: the last lanes have none of them in the end.
const STRETCH: usize = 256;

/// A replay and the steps it has made.
struct Lane<'a> {
    gather: Gather<'a>,
    steps: Vec<Step>,
}

/// The steps of a lane and their lines.
struct Stretch<'a> {
    steps: Vec<Step>,
    outputs: Outputs<'a>,
    lines: Vec<Line>,
}

/// Steps that are evaluated together, in their order.
pub(super) struct Round<'a>(Vec<Stretch<'a>>);

/// The lanes, in the order of the steps that they hold.
pub(super) struct Lanes<'a> {
    lanes: Vec<Lane<'a>>,
    /// The first step that no lane has made yet.
    next: u64,
    /// Evaluations of a step, about.
    cost: f64,
    /// How many steps a lane made last, at most.
    each: usize,
}

impl<'a> Lanes<'a> {
    /// Whether several lanes can go on where `gather` is.
    pub(super) fn are_there(gather: &Gather<'a>) -> bool {
        let holds = |alone: Alone<'_>| alone.holds_for(gather.replay.parameters());
        rayon::current_num_threads() > 1 && Alone::new(gather.job).is_some_and(holds)
    }

    /// The lanes that go on where `gather` is, one per thread, behind a first block of `count`
    /// steps.
    pub(super) fn behind(gather: Gather<'a>, count: usize) -> Self {
        let (job, threads) = (gather.job, rayon::current_num_threads());
        let lane = |gather| Lane { gather, steps: Vec::new() };
        let cost = gather.cost / count.max(1) as f64;
        let (control, part, next) = (gather.control, gather.part.clone(), gather.next);
        let mut lanes = vec![lane(gather)];
        lanes.extend((1..threads).map(|_| lane(Gather::new(job, control, part.clone()))));
        Self { lanes, next, cost, each: count.max(1) }
    }

    /// Replays the next steps, at most `most` in all lanes together but one in each; false if
    /// there are none.
    pub(super) fn replay(&mut self, most: usize) -> Result<bool, Failure> {
        let count = self.lanes.len();
        let enough = (BLOCK_EVALUATIONS / self.cost.max(1.0)) as usize;
        // Steps may become dearer: so the blocks grow slowly.
        let each = (most.min(enough) / count).clamp(1, STRETCH.min(2 * self.each));
        self.each = each;
        let starts = (self.next..).step_by(each);
        let replayed: Vec<Result<(), Failure>> = self
            .lanes
            .par_iter_mut()
            .zip(starts.take(count).collect::<Vec<_>>())
            .map(|(lane, start)| {
                lane.steps.clear();
                lane.gather.skip_to(start)?;
                lane.gather.add(&mut lane.steps, each, f64::INFINITY)
            })
            .collect();
        replayed.into_iter().collect::<Result<(), Failure>>()?;
        let steps = self.lanes.iter().map(|lane| lane.steps.len()).sum::<usize>();
        let cost: f64 = self.lanes.iter().map(|lane| lane.gather.cost).sum();
        self.cost = cost / steps.max(1) as f64;
        self.next += steps as u64;
        Ok(steps > 0)
    }

    /// Gives the steps replayed last to `round`, and takes those that it had to be forgotten.
    pub(super) fn hand_over(&mut self, round: &mut Round<'a>) {
        for (lane, stretch) in self.lanes.iter_mut().zip(&mut round.0) {
            std::mem::swap(&mut lane.steps, &mut stretch.steps);
        }
    }

    /// The number of steps replayed, of all that there were.
    pub(super) fn count(&self) -> u64 {
        self.next
    }
}

impl<'a> Round<'a> {
    /// A round of no steps yet, of so many `lanes`.
    pub(super) fn new(job: &'a Job, lanes: usize) -> Self {
        let stretch =
            || Stretch { steps: Vec::new(), outputs: Outputs::new(job), lines: Vec::new() };
        Self((0..lanes).map(|_| stretch()).collect())
    }

    /// The steps.
    pub(super) fn steps(&self) -> impl Iterator<Item = &Step> {
        self.0.iter().flat_map(|stretch| &stretch.steps)
    }

    /// Makes the lines of the steps, which came out as `all`.
    pub(super) fn fill(&mut self, all: &[Finished]) -> Result<(), Failure> {
        let mut rest = all;
        let mut parts = Vec::with_capacity(self.0.len());
        for stretch in &self.0 {
            let (part, behind) = rest.split_at(stretch.steps.len());
            parts.push(part);
            rest = behind;
        }
        let filled: Vec<Result<(), Failure>> =
            self.0.par_iter_mut().zip(parts).map(|(stretch, part)| stretch.fill(part)).collect();
        filled.into_iter().collect()
    }

    /// The steps and their lines.
    pub(super) fn lines(&self) -> impl Iterator<Item = (&Step, &Line)> {
        self.0.iter().flat_map(|stretch| stretch.steps.iter().zip(&stretch.lines))
    }
}

impl Stretch<'_> {
    fn fill(&mut self, all: &[Finished]) -> Result<(), Failure> {
        if self.lines.len() < all.len() {
            self.lines.resize_with(all.len(), Line::default);
        }
        for ((step, finished), line) in self.steps.iter().zip(all).zip(&mut self.lines) {
            self.outputs
                .fill(line, step, &finished.values)
                .map_err(|fault| at_step(step.index, fault))?;
        }
        Ok(())
    }
}
