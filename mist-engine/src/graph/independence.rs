//! Independence of steps: the property of a graph that a replay may start at any step.
//!
//! A step sees the steps before it in three places: variables that an entry reads before an entry
//! gives them, the bounds of the loops, and the model's parameters. Where none of them passes
//! anything on, the steps are independent.

use std::collections::{BTreeMap, BTreeSet};

use mist_format::{expr::Expr, number::whole_number};
use scattering::Mode;

use crate::{
    deviation::dialect,
    parameters::{ModelParameters, ParameterPath},
    plan::{ListPlan, LoopPlan, Plan},
};

/// Checks that remain for a job whose expressions pass on no values.
pub(crate) struct Independence {
    /// The parameters of the model that the loops change.
    changed: Vec<ParameterPath>,
}

impl Independence {
    /// None if a step of `plan` may depend on those before it. The caller has checked that no
    /// results are read by later steps.
    pub(super) fn of(plan: &Plan, mode: Mode) -> Option<Self> {
        if !reads_forward(plan) {
            return None;
        }
        let written = plan.loops.iter().flat_map(LoopPlan::entries).collect();
        let (entries, slots) = reached(plan, &written);
        let are_fixed = plan.loops.iter().all(|each| match each {
            LoopPlan::For(each) => {
                let mut read = each.bounds().into_iter().flat_map(|id| plan.slots_of(id));
                read.all(|slot| !slots.contains(slot))
            }
            LoopPlan::List(each) => reads_nothing(each, mode),
        });
        let path = |at: usize| plan.entries[at].parameter.as_ref().map(|path| (at, path));
        let sent: Vec<_> = (0..plan.entries.len()).filter_map(path).collect();
        let changed: Vec<_> = entries.into_iter().filter_map(path).collect();
        let are_last = changed.iter().all(|parameter| is_last(*parameter, &sent));
        let changed = changed.into_iter().map(|(_, path)| path.clone()).collect();
        (are_fixed && are_last).then_some(Self { changed })
    }

    /// True if setting the changed parameters in `parameters` replaces all that they were.
    pub(crate) fn holds_for(&self, parameters: &ModelParameters) -> bool {
        self.changed.iter().all(|path| parameters.belongs_to_object(path))
    }
}

/// True if every entry has a slot of its own and reads only slots of entries before it.
fn reads_forward(plan: &Plan) -> bool {
    let mut given = BTreeMap::new();
    for (at, entry) in plan.entries.iter().enumerate() {
        if let Some(slot) = entry.slot
            && given.insert(slot, at).is_some()
        {
            return false;
        }
    }
    plan.entries.iter().enumerate().all(|(at, entry)| {
        let mut read = entry.expr.iter().flat_map(Expr::slots);
        read.all(|slot| given.get(slot).is_none_or(|by| *by < at))
    })
}

/// The entries that change with the entries `written`, by themselves or through others, and their
/// slots.
pub(super) fn reached(plan: &Plan, written: &BTreeSet<usize>) -> (Vec<usize>, BTreeSet<u32>) {
    let (mut entries, mut slots) = (Vec::new(), BTreeSet::new());
    for (at, entry) in plan.entries.iter().enumerate() {
        let mut read = entry.expr.iter().flat_map(Expr::slots);
        if written.contains(&at) || read.any(|slot| slots.contains(slot)) {
            entries.push(at);
            slots.extend(entry.slot);
        }
    }
    (entries, slots)
}

/// True if no cell of a LIST file names a variable.
fn reads_nothing(plan: &ListPlan, mode: Mode) -> bool {
    let dialect = dialect(mode);
    (0..plan.file.row_count()).all(|row| {
        plan.columns.iter().enumerate().all(|(at, column)| {
            let cell = plan.file.cell(row, at);
            column.is_text
                || whole_number(cell).is_some()
                || Expr::compile(cell, dialect).is_ok_and(|expr| expr.names().is_empty())
        })
    })
}

/// True if `parameter` is set once per step, behind the objects that it belongs to, and nothing
/// inside of it is set.
pub(super) fn is_last(
    parameter: (usize, &ParameterPath),
    sent: &[(usize, &ParameterPath)],
) -> bool {
    let (at, path) = parameter;
    sent.iter().filter(|(other, _)| *other != at).all(|(other, other_path)| {
        let replaces = other_path.as_str() == path.as_str() || other_path.is_inside(path);
        !replaces && (!path.is_inside(other_path) || *other < at)
    })
}

#[cfg(test)]
mod tests;
