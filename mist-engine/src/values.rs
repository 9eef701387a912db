//! The values of a job's dependency graph during a replay: one memo per node.

use mist_format::{
    expr::{EvalError, Expr, OperandStack, Value},
    program::SourceText,
};

use crate::{
    Job,
    fault::{Fault, placed},
    graph::{DependencyGraph, NodeId, NodeSet},
    plan::{ExpressionId, Plan},
    slots::SlotValues,
};

/// The slots of a replay and the memos of its expressions.
pub(crate) struct NodeValues<'j> {
    plan: &'j Plan,
    graph: &'j DependencyGraph,
    slots: SlotValues,
    stack: OperandStack,
    /// The nodes whose memos do not hold.
    stale: NodeSet,
    /// The memos of the expressions.
    expressions: Vec<Option<Value>>,
}

impl<'j> NodeValues<'j> {
    /// The values before the first step of `job`.
    pub(crate) fn new(job: &'j Job) -> Self {
        let (plan, graph) = (&*job.plan, &*job.graph);
        let mut slots = SlotValues::new(plan.names.len(), job.library.clone());
        for (slot, value) in &*job.initial {
            slots.put(*slot, Some(value));
        }
        Self {
            plan,
            graph,
            slots,
            stack: OperandStack::default(),
            stale: NodeSet::all(graph.len()),
            expressions: vec![None; plan.expressions.len()],
        }
    }

    /// The value in `slot`.
    pub(crate) fn get(&self, slot: u32) -> Option<&Value> {
        self.slots.get(slot)
    }

    /// All slots, for expressions that belong to no node.
    pub(crate) fn slots_mut(&mut self) -> &mut SlotValues {
        &mut self.slots
    }

    /// Puts `value` into `slot`; `by` is the node that gives it, if one does.
    pub(crate) fn put(&mut self, slot: u32, value: Option<&Value>, by: Option<NodeId>) {
        if self.slots.put(slot, value) {
            self.make_stale(slot, by);
        }
    }

    /// [`NodeValues::put`] of one number.
    #[inline]
    pub(crate) fn set_number(&mut self, slot: u32, x: f64, by: Option<NodeId>) {
        if self.slots.set_number(slot, x) {
            self.make_stale(slot, by);
        }
    }

    #[inline]
    fn make_stale(&mut self, slot: u32, by: Option<NodeId>) {
        for node in self.graph.dependents(slot) {
            if Some(*node) != by {
                self.stale.insert(*node);
            }
        }
    }

    /// Sets the predefined variables of a step.
    pub(crate) fn set_predefined(&mut self) {
        for (slot, x) in self.graph.predefined() {
            self.set_number(*slot, *x, None);
        }
    }

    /// The node `node` is to be evaluated again.
    pub(crate) fn mark(&mut self, node: NodeId) {
        self.stale.insert(node);
    }

    /// True if the memo of `node` does not hold; the caller renews it.
    pub(crate) fn take(&mut self, node: NodeId) -> bool {
        self.stale.remove(node)
    }

    /// The first entry from `from` on that is to be evaluated; the caller does that.
    #[inline]
    pub(crate) fn next_entry(&mut self, from: usize) -> Option<usize> {
        let found = self.stale.first(from, self.graph.entries_end())?;
        self.stale.remove(found);
        Some(found)
    }

    /// The number of an expression that has one without general evaluation.
    #[inline]
    pub(crate) fn short_number(&mut self, expr: &Expr) -> Option<f64> {
        self.slots.short_number(expr, &mut self.stack)
    }

    /// The value of an expression without a memo, written at `text`.
    pub(crate) fn evaluate(&mut self, expr: &Expr, text: &SourceText) -> Result<Value, Fault> {
        let value = self.evaluate_raw(expr);
        value.map_err(|error| placed(text, error.diagnostic(self.known())))
    }

    /// The value of an expression without a memo.
    pub(crate) fn evaluate_raw(&mut self, expr: &Expr) -> Result<Value, EvalError> {
        self.slots.value(expr, &mut self.stack)
    }

    /// The value of the expression `id`, written at `text`.
    pub(crate) fn expression(
        &mut self,
        id: ExpressionId,
        text: &SourceText,
    ) -> Result<&Value, Fault> {
        let node = self.graph.expression(id);
        if self.stale.remove(node) {
            match self.evaluate(self.plan.expression(id), text) {
                Ok(value) => self.expressions[id.0] = Some(value),
                Err(fault) => {
                    self.stale.insert(node);
                    return Err(fault);
                }
            }
        }
        Ok(self.expressions[id.0].as_ref().expect("a memo that holds has a value"))
    }

    /// The last element of the value of the expression `id`, written at `text`.
    pub(crate) fn number(&mut self, id: ExpressionId, text: &SourceText) -> Result<f64, Fault> {
        self.expression(id, text).map(Value::number)
    }

    /// The names of all variables that have a value.
    pub(crate) fn known(&self) -> Vec<&'j str> {
        self.slots.defined().map(|slot| self.plan.names.name(slot)).collect()
    }
}
