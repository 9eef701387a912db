//! The dependency graph of a compiled program.
//!
//! A replay evaluates nodes: the entries of VARIABLES in their order, the expressions of loop
//! bounds, incident light and apertures when they are asked for, the list of apertures, and the
//! list of values that the outputs read. Each node has one memo. The edges are slots: a node
//! depends on the slots that it reads, and a slot that gets another value makes the memos of its
//! dependents stale ([`DependencyGraph::dependents`]). An entry also depends on the slot that it
//! gives if something else writes the same slot: then it has to give its value again.
//!
//! The graph also tells which order the steps of a job need: whether results of a step are read
//! by a later one ([`DependencyGraph::in_order`]), whether the apertures of a step read its own
//! integrals ([`DependencyGraph::chained`]), and whether a replay may start at any step
//! ([`Independence`]).

mod independence;
mod parameters_only;

use std::collections::BTreeSet;

use mist_format::expr::Expr;
use scattering::Mode;

pub(crate) use independence::Independence;

use crate::{
    deviation::EngineDeviation,
    plan::{ExpressionId, LoopPlan, Plan},
};

/// Position of a node among all nodes of a graph.
pub(crate) type NodeId = usize;

/// The nodes of a program and what they depend on.
pub(crate) struct DependencyGraph {
    /// Number of entries: their nodes come first, in their order.
    entries: usize,
    /// Number of expressions: their nodes follow the entries.
    expressions: usize,
    /// For each slot the nodes whose memos are stale when it changes.
    dependents: Vec<Vec<NodeId>>,
    /// The predefined variables that a step sets before its entries, with their values.
    predefined: Vec<(u32, f64)>,
    /// For each entry those that set a parameter inside of the object that it sets.
    inside: Vec<Vec<usize>>,
    /// True if variables, loops or apertures read integrals or outputs of earlier steps.
    pub(crate) in_order: bool,
    /// True if an aperture reads an integral or output, so that integrals are computed one by one.
    pub(crate) chained: bool,
    /// True if no output reads what an output gave in the line before.
    pub(crate) lines_independent: bool,
    /// Independence of the steps; `None` if a step may depend on earlier ones.
    pub(crate) independence: Option<Independence>,
}

impl DependencyGraph {
    /// The graph of `plan`.
    pub(crate) fn new(plan: &Plan, mode: Mode) -> Self {
        let (entries, expressions) = (plan.entries.len(), plan.expressions.len());
        let (in_order, chained) = (reads_results(plan), is_chained(plan));
        let mut graph = Self {
            entries,
            expressions,
            dependents: vec![Vec::new(); plan.names.len()],
            predefined: predefined(plan, mode),
            inside: inside(plan, mode),
            in_order,
            chained,
            lines_independent: lines_are_independent(plan),
            independence: (!in_order).then(|| Independence::of(plan, mode)).flatten(),
        };
        graph.connect(plan);
        graph
    }

    /// Number of nodes.
    pub(crate) fn len(&self) -> usize {
        self.output_values() + 1
    }

    /// The entries of VARIABLES: the nodes below this one.
    pub(crate) fn entries_end(&self) -> NodeId {
        self.entries
    }

    /// The node of an expression.
    pub(crate) fn expression(&self, id: ExpressionId) -> NodeId {
        self.entries + id.0
    }

    /// The node of all apertures of a step.
    pub(crate) fn apertures(&self) -> NodeId {
        self.entries + self.expressions
    }

    /// The node of the values that outputs read.
    pub(crate) fn output_values(&self) -> NodeId {
        self.apertures() + 1
    }

    /// The nodes whose memos are stale when `slot` changes.
    #[inline]
    pub(crate) fn dependents(&self, slot: u32) -> &[NodeId] {
        self.dependents.get(slot as usize).map_or(&[], Vec::as_slice)
    }

    /// The predefined variables that a step sets before its entries, with their values.
    pub(crate) fn predefined(&self) -> &[(u32, f64)] {
        &self.predefined
    }

    /// The entries to be sent to the model again after the entry `at`, because it has replaced
    /// the object that they belong to.
    pub(crate) fn inside(&self, at: usize) -> &[usize] {
        &self.inside[at]
    }

    /// Fills in the dependents of all slots.
    fn connect(&mut self, plan: &Plan) {
        let written = written_elsewhere(plan, &self.predefined);
        for (at, entry) in plan.entries.iter().enumerate() {
            let reads = entry.expr.iter().flat_map(Expr::slots).copied();
            let own = entry.slot.filter(|slot| written.contains(slot));
            self.add(at, reads.chain(own));
        }
        for at in 0..plan.expressions.len() {
            self.add(self.entries + at, plan.expressions[at].slots().iter().copied());
        }
        let required = &plan.required;
        let sampling = [
            required.differential,
            required.minsamples,
            required.integrationmode,
            required.polygonsides,
            required.tolerance,
            required.maxevaluations,
        ];
        let settings = plan.integrals.iter().flat_map(|integral| &integral.settings);
        let incident = required.incidentpol.iter().map(|(_, expr)| *expr);
        let read: Vec<u32> = settings
            .map(|setting| setting.expr)
            .chain(incident)
            .flat_map(|id| plan.slots_of(id).iter().copied())
            .chain(sampling)
            .collect();
        self.add(self.apertures(), read.into_iter());
        self.add(self.output_values(), plan.reads.iter().copied());
    }

    fn add(&mut self, node: NodeId, reads: impl Iterator<Item = u32>) {
        for slot in reads {
            // A name that nothing gives has no slot; reading it is an error.
            if let Some(dependents) = self.dependents.get_mut(slot as usize)
                && dependents.last() != Some(&node)
            {
                dependents.push(node);
            }
        }
    }
}

/// The predefined variables, without those that an entry gives before anything reads them.
fn predefined(plan: &Plan, mode: Mode) -> Vec<(u32, f64)> {
    let required = &plan.required;
    let integration = if EngineDeviation::GridIntegrals.applies_in(mode) { 2.0 } else { 20.0 };
    let settings = [(required.integrationmode, integration), (required.polygonsides, 360.0)];
    let all = settings.into_iter().chain(required.constants());
    let is_needed = |slot: u32| {
        for entry in &plan.entries {
            if entry.expr.iter().any(|expr| expr.slots().contains(&slot)) {
                return true;
            }
            if entry.slot == Some(slot) {
                return false;
            }
        }
        true
    };
    all.filter(|(slot, _)| is_needed(*slot)).collect()
}

/// The slots that something else writes besides one entry.
fn written_elsewhere(plan: &Plan, predefined: &[(u32, f64)]) -> BTreeSet<u32> {
    let mut once = BTreeSet::new();
    let again = plan.entries.iter().filter_map(|entry| entry.slot);
    let again = again.filter(|slot| !once.insert(*slot)).collect::<Vec<_>>();
    again
        .into_iter()
        .chain(predefined.iter().map(|(slot, _)| *slot))
        .chain(plan.results())
        .collect()
}

/// For each entry those that set a parameter inside of the object that it sets. NIST's program
/// does not send them again.
fn inside(plan: &Plan, mode: Mode) -> Vec<Vec<usize>> {
    let inside = |at: usize| -> Vec<usize> {
        let Some(path) = &plan.entries[at].parameter else { return Vec::new() };
        let others = plan.entries.iter().enumerate().filter(|(other, _)| *other != at);
        let below = others.filter(|(_, entry)| {
            entry.parameter.as_ref().is_some_and(|other| other.is_inside(path))
        });
        below.map(|(other, _)| other).collect()
    };
    if EngineDeviation::NoResend.applies_in(mode) {
        return vec![Vec::new(); plan.entries.len()];
    }
    (0..plan.entries.len()).map(inside).collect()
}

/// True if an aperture reads an integral or an output.
fn is_chained(plan: &Plan) -> bool {
    let results: BTreeSet<u32> = plan.results().collect();
    let settings = plan.integrals.iter().flat_map(|integral| &integral.settings);
    settings.flat_map(|setting| plan.slots_of(setting.expr)).any(|slot| results.contains(slot))
}

/// True if variables, loop bounds or apertures read integrals or outputs.
fn reads_results(plan: &Plan) -> bool {
    let results: BTreeSet<u32> = plan.results().collect();
    let required = &plan.required;
    let slots =
        [required.incidentangle, required.differential, required.minsamples, required.rotation];
    let reads = |expr: &Expr| expr.slots().iter().any(|slot| results.contains(slot));
    let is_fed_back = |each: &LoopPlan| match each {
        LoopPlan::For(plan) => plan.fed_back,
        LoopPlan::List(plan) => plan.fed_back,
    };
    plan.entries.iter().filter_map(|entry| entry.expr.as_ref()).any(reads)
        || plan.expressions.iter().any(reads)
        || slots.iter().any(|slot| results.contains(slot))
        || plan.loops.iter().any(is_fed_back)
}

/// True if no output reads what it or one behind it gave in the line before. Every line begins
/// with the variables and the integrals of its step, whatever outputs are called.
fn lines_are_independent(plan: &Plan) -> bool {
    let variables = plan.entries.iter().filter_map(|entry| entry.slot);
    let integrals = plan.integrals.iter().map(|integral| integral.slot);
    let fresh: BTreeSet<u32> = variables.chain(integrals).collect();
    plan.outputs.iter().enumerate().all(|(at, output)| {
        let later: BTreeSet<u32> = plan.outputs[at..].iter().map(|other| other.slot).collect();
        output.expr.slots().iter().all(|slot| fresh.contains(slot) || !later.contains(slot))
    })
}

/// A set of nodes, 64 to a word.
#[derive(Clone, Debug)]
pub(crate) struct NodeSet(Vec<u64>);

impl NodeSet {
    /// All of `count` nodes.
    pub(crate) fn all(count: usize) -> Self {
        Self(vec![u64::MAX; count.div_ceil(64)])
    }

    #[inline]
    pub(crate) fn insert(&mut self, node: NodeId) {
        self.0[node / 64] |= 1 << (node % 64);
    }

    /// Removes `node`; returns whether it was in the set.
    #[inline]
    pub(crate) fn remove(&mut self, node: NodeId) -> bool {
        let (word, bit) = (&mut self.0[node / 64], 1 << (node % 64));
        let was_in = *word & bit != 0;
        *word &= !bit;
        was_in
    }

    /// The first node of the set from `from` on that is below `end`.
    #[inline]
    pub(crate) fn first(&self, from: NodeId, end: NodeId) -> Option<NodeId> {
        let mut word = from / 64;
        let mut here = self.0.get(word)? & (u64::MAX << (from % 64));
        while here == 0 {
            word += 1;
            here = *self.0.get(word)?;
        }
        let found = word * 64 + here.trailing_zeros() as usize;
        (found < end).then_some(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_gives_its_nodes_in_order() {
        let mut set = NodeSet::all(200);
        (0..200).filter(|node| node % 67 != 5).for_each(|node| assert!(set.remove(node)));
        let mut found = Vec::new();
        let mut from = 0;
        while let Some(node) = set.first(from, 150) {
            found.push(node);
            from = node + 1;
        }
        assert_eq!(found, [5, 72, 139]);
        set.insert(0);
        assert_eq!((set.first(0, 1), set.first(1, 5), set.remove(1)), (Some(0), None, false));
    }
}
