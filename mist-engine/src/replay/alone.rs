//! Whether steps can be replayed without those before them.
//!
//! A step sees what the steps before it have left in three places: variables that an entry reads
//! before an entry gives them, the bounds of the loops, and the model's parameters. Where none of
//! them hands anything on, a replay may start at any step.

use std::collections::{BTreeMap, BTreeSet};

use mist_format::{expr::Expr, number::whole_number};

use crate::{
    Job,
    parameters::{ModelParameters, is_below},
    quirk::dialect,
    sweep::{ListPlan, LoopPlan},
};

/// What is left to be asked of a job whose expressions hand nothing on.
pub(crate) struct Alone<'j> {
    /// The parameters of the model that the loops change.
    changed: Vec<&'j str>,
}

impl<'j> Alone<'j> {
    /// None where a step may depend on those before it.
    pub(crate) fn new(job: &'j Job) -> Option<Self> {
        if job.in_order || !reads_backwards(job) {
            return None;
        }
        let (entries, slots) = changed(job);
        let is_fixed = |expr: &Expr| expr.slots().iter().all(|slot| !slots.contains(slot));
        let are_fixed = job.loops.iter().all(|each| match each {
            LoopPlan::For(plan) => [&plan.from, &plan.to, &plan.by].into_iter().all(is_fixed),
            LoopPlan::List(plan) => reads_nothing(plan, job),
        });
        let named = |at: usize| job.entries[at].parameter.as_deref().map(|name| (at, name));
        let sent: Vec<(usize, &str)> = (0..job.entries.len()).filter_map(named).collect();
        let changed: Vec<(usize, &str)> = entries.into_iter().filter_map(named).collect();
        let are_last = changed.iter().all(|parameter| is_last(*parameter, &sent));
        let changed = changed.into_iter().map(|(_, name)| name).collect();
        (are_fixed && are_last).then_some(Self { changed })
    }

    /// Whether setting the changed parameters in `parameters` replaces all that they were.
    pub(crate) fn holds_for(&self, parameters: &ModelParameters) -> bool {
        self.changed.iter().all(|name| parameters.belongs_to_object(name))
    }
}

impl Job {
    /// Whether no output reads what it or one behind it gave in the line before: every line
    /// begins with the variables and the integrals of its step, whatever outputs are called.
    pub(crate) fn lines_stand_alone(&self) -> bool {
        let variables = self.entries.iter().filter_map(|entry| entry.slot);
        let integrals = self.integrals.iter().map(|plan| plan.slot);
        let fresh: BTreeSet<u32> = variables.chain(integrals).collect();
        self.outputs.iter().enumerate().all(|(at, output)| {
            let later: BTreeSet<u32> = self.outputs[at..].iter().map(|other| other.slot).collect();
            output.expr.slots().iter().all(|slot| fresh.contains(slot) || !later.contains(slot))
        })
    }
}

/// Whether every entry has a slot of its own and reads only slots of entries before it.
fn reads_backwards(job: &Job) -> bool {
    let mut given = BTreeMap::new();
    for (at, entry) in job.entries.iter().enumerate() {
        if let Some(slot) = entry.slot
            && given.insert(slot, at).is_some()
        {
            return false;
        }
    }
    job.entries.iter().enumerate().all(|(at, entry)| {
        let mut read = entry.expr.iter().flat_map(Expr::slots);
        read.all(|slot| given.get(slot).is_none_or(|by| *by < at))
    })
}

/// The entries that loops change, by themselves or through others, and their slots.
fn changed(job: &Job) -> (Vec<usize>, BTreeSet<u32>) {
    let written: BTreeSet<usize> = job.loops.iter().flat_map(LoopPlan::entries).collect();
    let (mut entries, mut slots) = (Vec::new(), BTreeSet::new());
    for (at, entry) in job.entries.iter().enumerate() {
        let mut read = entry.expr.iter().flat_map(Expr::slots);
        if written.contains(&at) || read.any(|slot| slots.contains(slot)) {
            entries.push(at);
            slots.extend(entry.slot);
        }
    }
    (entries, slots)
}

/// Whether no cell of a LIST file names a variable.
fn reads_nothing(plan: &ListPlan, job: &Job) -> bool {
    let dialect = dialect(job.options.mode);
    (0..plan.file.row_count()).all(|row| {
        plan.columns.iter().enumerate().all(|(at, column)| {
            let cell = plan.file.cell(row, at);
            column.is_text
                || whole_number(cell).is_some()
                || Expr::compile(cell, dialect).is_ok_and(|expr| expr.names().is_empty())
        })
    })
}

/// Whether `parameter` is set once per step, behind the objects that it belongs to, and nothing
/// below it is set.
fn is_last(parameter: (usize, &str), sent: &[(usize, &str)]) -> bool {
    let (at, name) = parameter;
    sent.iter().filter(|(other, _)| *other != at).all(|(other, other_name)| {
        let below_it = *other_name == name || is_below(other_name, name);
        !below_it && (!is_below(name, other_name) || *other < at)
    })
}

#[cfg(test)]
mod tests;
