//! Replaying steps until there are enough of them to be evaluated together.

use std::ops::Range;

use crate::{Control, Failure, Job, fault::at_step, replay::Replay, sampling::Layout, step::Step};

/// Steps that are replayed before they are evaluated together.
pub(super) const BLOCK_STEPS: usize = 256;

/// Evaluations after which a block is closed, so that progress is seen and a cancellation takes effect.
pub(super) const BLOCK_EVALUATIONS: f64 = 2e6;

/// Evaluations of an adaptive integral, about; it may be a thousand times more.
const ADAPTIVE_EVALUATIONS: f64 = 2e4;

/// Steps skipped between two checks for cancellation.
const SKIPPED: u64 = 1 << 16;

/// A replay and how far it is.
pub(super) struct StepReader<'a> {
    pub(super) job: &'a Job,
    pub(super) control: &'a Control,
    pub(super) replay: Replay<'a>,
    /// The steps to be evaluated, unless all are.
    pub(super) part: Option<Range<u64>>,
    /// The number of the next step.
    pub(super) next: u64,
    /// About how many directions the steps gathered last have.
    pub(super) cost: f64,
}

impl<'a> StepReader<'a> {
    /// At the beginning of `job`; `shows` as for [`Replay::showing`].
    pub(super) fn new(
        job: &'a Job,
        control: &'a Control,
        part: Option<Range<u64>>,
        shows: bool,
    ) -> Self {
        let replay = Replay::new(job).showing(shows);
        Self { job, control, replay, part, next: 0, cost: 0.0 }
    }

    /// The steps of the next block, at most `most`; empty behind the last step.
    pub(super) fn block(&mut self, most: usize) -> Result<Vec<Step>, Failure> {
        if self.replay.has_ended() {
            return Ok(Vec::new());
        }
        let mut block = Vec::with_capacity(most);
        self.add(&mut block, most, BLOCK_EVALUATIONS)?;
        Ok(block)
    }

    /// Puts the next steps into `block`, at most `most` and until their evaluations are `enough`.
    pub(super) fn add(
        &mut self,
        block: &mut Vec<Step>,
        most: usize,
        enough: f64,
    ) -> Result<(), Failure> {
        self.cost = 0.0;
        while block.len() < most && self.cost < enough {
            let index = self.next;
            if self.part.as_ref().is_some_and(|part| index >= part.end) {
                break;
            }
            // Steps are large: they go from where they are made to their place.
            match self.replay.next_step() {
                Ok(Some(step)) => block.push(step),
                Ok(None) => break,
                Err(fault) => return Err(at_step(index, fault)),
            }
            self.next += 1;
            self.job.within_limit(self.next)?;
            if self.part.as_ref().is_some_and(|part| index < part.start) {
                block.pop();
                if self.control.is_cancelled() {
                    return Err(Failure::Cancelled);
                }
            } else if let Some(step) = block.last() {
                self.cost += price(self.job, step)?;
                // Computed here, in parallel by the workers.
                step.parameters.hash_code();
            }
        }
        Ok(())
    }

    /// Goes from the beginning to step `to` if that is possible without making the steps before.
    pub(super) fn approach(&mut self, to: u64) -> Result<(), Failure> {
        if self.job.graph.independence.is_none() || to <= 1 {
            return Ok(());
        }
        self.skip_to(1)?;
        if self.steps_are_independent() { self.skip_to(to) } else { Ok(()) }
    }

    /// True if the replay, behind its first step, may go on at any step.
    pub(super) fn steps_are_independent(&self) -> bool {
        let independence = self.job.graph.independence.as_ref();
        independence.is_some_and(|all| all.holds_for(self.replay.parameters()))
    }

    /// Goes on to step `to` without making the steps before it.
    pub(super) fn skip_to(&mut self, to: u64) -> Result<(), Failure> {
        while self.next < to {
            let near = to.min(self.next + SKIPPED);
            self.replay.skip_to(near).map_err(|fault| at_step(self.next, fault))?;
            self.next = near;
            if self.control.is_cancelled() {
                return Err(Failure::Cancelled);
            }
        }
        Ok(())
    }
}

/// About how many directions the integrals of `step` have.
pub(super) fn price(job: &Job, step: &Step) -> Result<f64, Failure> {
    let limit = job.options.limits.directions;
    let mut cost = 0.0;
    for (integral, plan) in step.integrals.iter().zip(&job.plan.integrals) {
        let Some((plane, _)) = integral.rule.plane() else {
            cost += ADAPTIVE_EVALUATIONS;
            continue;
        };
        let estimate = Layout::estimate(&integral.region, plane);
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
