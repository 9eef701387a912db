//! Values that reach nothing but parameters of the model.
//!
//! If the caller of a job changes only such values, its loops, apertures and outputs stay as they are:
//! the steps of one run serve the next one ([`crate::run::ReusableSteps`]).

use std::collections::BTreeSet;

use super::{
    DependencyGraph,
    independence::{is_last, reached},
};
use crate::plan::{LoopPlan, Plan};

impl DependencyGraph {
    /// The entries that set parameters of the model to values that depend on the entries `given`.
    /// None if anything else of a step depends on them, or if a loop changes these values too.
    pub(crate) fn parameters_of(&self, plan: &Plan, given: &[usize]) -> Option<Vec<usize>> {
        self.independence.as_ref()?;
        let (entries, slots) = reached(plan, &given.iter().copied().collect());
        let written: BTreeSet<usize> = plan.loops.iter().flat_map(LoopPlan::entries).collect();
        let (by_loops, _) = reached(plan, &written);
        let required = &plan.required;
        let read_by_steps = [
            required.incidentangle,
            required.differential,
            required.minsamples,
            required.rotation,
            required.integrationmode,
            required.polygonsides,
            required.tolerance,
            required.maxevaluations,
        ];
        let expressions = plan.expressions.iter().flat_map(|expr| expr.slots());
        let mut read = read_by_steps.iter().chain(expressions).chain(&plan.reads);
        if read.any(|slot| slots.contains(slot)) || entries.iter().any(|at| by_loops.contains(at)) {
            return None;
        }
        let path = |at: usize| plan.entries[at].parameter.as_ref().map(|path| (at, path));
        let sent: Vec<_> = (0..plan.entries.len()).filter_map(path).collect();
        let set: Vec<_> = entries.into_iter().filter_map(path).collect();
        let are_last = set.iter().all(|parameter| is_last(*parameter, &sent));
        are_last.then(|| set.into_iter().map(|(at, _)| at).collect())
    }
}
