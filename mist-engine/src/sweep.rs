//! The nested loops of VARY.
//!
//! The last declared loop runs fastest. A loop does not set a variable but replaces the text of
//! its entry in VARIABLES; what the other entries make of it is decided when the step evaluates
//! them.

mod for_loop;
mod list_loop;

pub(crate) use for_loop::{ForPlan, ForState};
pub(crate) use list_loop::{ListColumn, ListPlan, ListState};

use std::sync::Arc;

use mist_format::expr::Stack;
use scattering::Mode;

use crate::{Job, fault::Fault, scope::SlotValues, step::LoopCells};

/// A loop as compiled.
pub(crate) enum LoopPlan {
    For(Box<ForPlan>),
    List(ListPlan),
}

impl LoopPlan {
    /// Entries of VARIABLES that the loop writes.
    pub(crate) fn entries(&self) -> Vec<usize> {
        match self {
            Self::For(plan) => vec![plan.entry],
            Self::List(plan) => plan.columns.iter().map(|column| column.entry).collect(),
        }
    }

    /// Names of its columns in the results.
    pub(crate) fn titles(&self) -> Vec<&str> {
        match self {
            Self::For(plan) => vec![plan.title.as_str()],
            Self::List(plan) => plan.columns.iter().map(|c| c.title.as_str()).collect(),
        }
    }
}

/// What a loop writes into an entry of VARIABLES.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LoopWrite {
    /// The entry.
    pub(crate) entry: usize,
    /// What it says from now on.
    pub(crate) content: EntryContent,
}

/// The new content of an entry of VARIABLES.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum EntryContent {
    /// A text that is a number, where the text itself is not wanted.
    Number(f64),
    /// An expression, or a text for the model.
    Text(Arc<str>),
}

/// What loops need to evaluate their expressions.
pub(crate) struct LoopContext<'a> {
    pub(crate) scope: &'a mut SlotValues,
    pub(crate) stack: &'a mut Stack,
    pub(crate) names: &'a crate::scope::SlotNames,
    pub(crate) mode: Mode,
}

impl<'a> LoopContext<'a> {
    /// That of `job`.
    pub(crate) fn of(job: &'a Job, scope: &'a mut SlotValues, stack: &'a mut Stack) -> Self {
        Self { scope, stack, names: &job.names, mode: job.options.mode }
    }
}

/// Where a loop stands.
pub(crate) enum LoopState {
    For(ForState),
    List(ListState),
}

/// All loops, the first declared first.
pub(crate) struct Sweep<'j> {
    plans: &'j [LoopPlan],
    states: Vec<LoopState>,
    /// The first loop that has moved since the loops were last written; all behind it have too.
    moved: usize,
    /// Whether the loops were never written.
    is_new: bool,
    /// What was written last.
    written: Vec<LoopWrite>,
    /// How often each loop was advanced since it was reset.
    counts: Vec<u64>,
}

impl<'j> Sweep<'j> {
    /// Every loop at its first value.
    pub(crate) fn start(
        plans: &'j [LoopPlan],
        context: &mut LoopContext<'_>,
    ) -> Result<Self, Fault> {
        let start = |plan: &LoopPlan| match plan {
            LoopPlan::For(plan) => ForState::start(plan, context).map(LoopState::For),
            LoopPlan::List(_) => Ok(LoopState::List(ListState::start())),
        };
        let states = plans.iter().map(start).collect::<Result<_, _>>()?;
        let counts = vec![0; plans.len()];
        Ok(Self { plans, states, moved: 0, is_new: true, written: Vec::new(), counts })
    }

    /// Goes to the next combination; false after the last one.
    pub(crate) fn advance(&mut self, context: &mut LoopContext<'_>) -> Result<bool, Fault> {
        for at in (0..self.plans.len()).rev() {
            self.moved = self.moved.min(at);
            let inside = match (&self.plans[at], &mut self.states[at]) {
                (LoopPlan::For(plan), LoopState::For(state)) => state.advance(plan, context)?,
                (LoopPlan::List(plan), LoopState::List(state)) => state.advance(plan),
                _ => false,
            };
            if inside {
                self.counts[at] += 1;
                return Ok(true);
            }
            self.counts[at] = 0;
            match (&self.plans[at], &mut self.states[at]) {
                (LoopPlan::For(plan), LoopState::For(state)) => state.restart(plan, context)?,
                (LoopPlan::List(_), LoopState::List(state)) => *state = ListState::start(),
                _ => {}
            }
        }
        Ok(false)
    }

    /// What the loops that have moved since the last call write into entries: in the beginning as
    /// they are declared, later the last one first, as they have moved.
    pub(crate) fn write(
        &mut self,
        context: &mut LoopContext<'_>,
    ) -> Result<std::vec::Drain<'_, LoopWrite>, Fault> {
        let (first, count) = (self.moved, self.plans.len());
        for at in first..count {
            let at = if self.is_new { at } else { count - 1 - (at - first) };
            match (&self.plans[at], &mut self.states[at]) {
                (LoopPlan::For(plan), LoopState::For(state)) => {
                    state.write(plan, &mut self.written);
                }
                (LoopPlan::List(plan), LoopState::List(state)) => {
                    state.write(plan, context, &mut self.written)?;
                }
                _ => {}
            }
        }
        (self.moved, self.is_new) = (count, false);
        Ok(self.written.drain(..))
    }

    /// The loop columns of the current step: the last declared loop first.
    pub(crate) fn cells(&self) -> LoopCells {
        let mut cells = LoopCells::new();
        for (plan, state) in self.plans.iter().zip(&self.states).rev() {
            match (plan, state) {
                (LoopPlan::For(_), LoopState::For(state)) => cells.push(state.cell().clone()),
                (LoopPlan::List(_), LoopState::List(state)) => {
                    cells.extend(state.cells().iter().cloned());
                }
                _ => {}
            }
        }
        cells
    }

    /// How far the first declared loop is, from 0 to 1.
    pub(crate) fn fraction(&self) -> f64 {
        match (self.plans.first(), self.states.first()) {
            (Some(LoopPlan::For(_)), Some(LoopState::For(state))) => state.fraction(),
            (Some(LoopPlan::List(plan)), Some(LoopState::List(state))) => state.fraction(plan),
            _ => 0.0,
        }
    }

    /// How often each loop was advanced: the place of the step in the nest.
    pub(crate) fn counts(&self) -> &[u64] {
        &self.counts
    }
}
