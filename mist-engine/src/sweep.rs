//! The nested loops of VARY.
//!
//! The last declared loop runs fastest. A loop does not set a variable but replaces the content
//! of its entry in VARIABLES; the step evaluates the entry with that content.

mod content;
mod for_loop;
mod list_loop;

use crate::{fault::Fault, plan::LoopPlan, step::LoopCells};
pub(crate) use content::{EntryContent, LoopContext, LoopWrite};

use for_loop::ForState;
use list_loop::ListState;

/// The position of a loop.
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
    /// True if the loops were never written.
    is_new: bool,
    /// The contents written last.
    written: Vec<LoopWrite>,
    /// Number of advances of each loop since its reset.
    counts: Vec<u64>,
}

impl<'j> Sweep<'j> {
    /// Every loop at its first value.
    pub(crate) fn start(
        plans: &'j [LoopPlan],
        context: &mut LoopContext<'_, '_>,
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
    pub(crate) fn advance(&mut self, context: &mut LoopContext<'_, '_>) -> Result<bool, Fault> {
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

    /// Writes into entries by the loops that have advanced since the last call: in the beginning as
    /// they are declared, later the last one first, as they have moved.
    pub(crate) fn write(
        &mut self,
        context: &mut LoopContext<'_, '_>,
    ) -> Result<std::vec::Drain<'_, LoopWrite>, Fault> {
        let (first, count) = (self.moved, self.plans.len());
        for at in first..count {
            let at = if self.is_new { at } else { count - 1 - (at - first) };
            match (&self.plans[at], &mut self.states[at]) {
                (LoopPlan::For(plan), LoopState::For(state)) => {
                    state.write(plan, (context.mode, context.shows), &mut self.written);
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

    /// Progress of the first declared loop, from 0 to 1.
    pub(crate) fn fraction(&self) -> f64 {
        match (self.plans.first(), self.states.first()) {
            (Some(LoopPlan::For(_)), Some(LoopState::For(state))) => state.fraction(),
            (Some(LoopPlan::List(plan)), Some(LoopState::List(state))) => state.fraction(plan),
            _ => 0.0,
        }
    }

    /// Number of advances of each loop: the position of the step in the nest.
    pub(crate) fn counts(&self) -> &[u64] {
        &self.counts
    }
}
