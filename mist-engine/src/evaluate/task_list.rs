//! The integrals that a block of steps needs, and the tasks that compute them.

use std::sync::Arc;

use rayon::prelude::*;
use scattering::{Direction, Incidence};

use super::{
    cache::FastMap,
    task::{
        ApertureId, IntegralKey, IntegralTask, MuellerResult, NumberedDirections, TaskDirections,
        TaskError, TaskResult,
    },
};
use crate::{
    region::Region,
    sampling::{Layout, LayoutKey},
    step::{Step, StepIntegral},
};

/// Tasks of a block of steps.
#[derive(Default)]
pub(super) struct TaskList {
    /// For every integral of every step, in order, the place of its result.
    pub(super) places: Vec<usize>,
    pub(super) found: Vec<MuellerResult>,
    pub(super) known: FastMap<IntegralKey, usize>,
    /// The key that was looked for last, and its place.
    pub(super) last: Option<(IntegralKey, usize)>,
    pub(super) work: Vec<IntegralTask>,
    /// Layouts that an earlier block has used.
    pub(super) again: Vec<Arc<Layout>>,
    /// Results of the tasks.
    pub(super) done: Vec<Result<TaskResult, TaskError>>,
    /// The integrals that were looked at last, and where they collect light.
    pub(super) integrals: Option<Arc<Vec<StepIntegral>>>,
    pub(super) apertures: Vec<(ApertureId, TaskDirections)>,
    /// The beam that was looked at last.
    pub(super) beam: Option<Incidence>,
}

impl TaskList {
    /// Stores the directions of layouts that more than one integral wants.
    pub(super) fn store_shared(&self) {
        let mut wanted: Vec<&Arc<Layout>> = self.again.iter().collect();
        wanted.extend(self.work.iter().filter_map(|piece| match &piece.place {
            TaskDirections::Area(layout) => Some(layout),
            _ => None,
        }));
        wanted.sort_unstable_by_key(|layout| Arc::as_ptr(layout));
        let shared = wanted.chunk_by(|a, b| Arc::ptr_eq(a, b)).filter(|uses| uses.len() > 1);
        let shared: Vec<&Arc<Layout>> = shared.map(|uses| uses[0]).collect();
        shared.into_par_iter().for_each(|layout| layout.store());
    }

    /// Makes room for the next block; the memory is used again.
    pub(super) fn forget(&mut self) {
        self.places.clear();
        self.found.clear();
        self.known.clear();
        self.last = None;
        self.work.clear();
        self.again.clear();
        self.integrals = None;
        self.apertures.clear();
    }

    /// The beam of `step`.
    pub(super) fn beam_of(&mut self, step: &Step) -> Incidence {
        let angles = [step.theta_i, step.rotation].map(f64::to_bits);
        match self.beam {
            Some(beam) if [beam.theta(), beam.rotation()].map(f64::to_bits) == angles => beam,
            _ => self.next_beam(step),
        }
    }

    /// Apart from the other, else its sines are computed whether they are wanted or not.
    #[cold]
    #[inline(never)]
    fn next_beam(&mut self, step: &Step) -> Incidence {
        *self.beam.insert(Incidence::new(step.theta_i, step.rotation))
    }

    /// Regions in which `integrals` collect light.
    pub(super) fn look_at(
        &mut self,
        integrals: &Arc<Vec<StepIntegral>>,
        layouts: &FastMap<LayoutKey, NumberedDirections>,
    ) {
        if self.integrals.as_ref().is_some_and(|before| Arc::ptr_eq(before, integrals)) {
            return;
        }
        self.integrals = Some(integrals.clone());
        self.apertures.clear();
        self.apertures.extend(integrals.iter().map(|integral| match &integral.region {
            Region::Differential { center: (theta, phi) } => {
                let direction = Direction::new(*theta, *phi);
                (
                    ApertureId::Point(theta.to_bits(), phi.to_bits()),
                    TaskDirections::Point(direction),
                )
            }
            _ => {
                let (id, place) = &layouts[&integral.layout_key()];
                (ApertureId::Area(*id), place.clone())
            }
        }));
    }
}
