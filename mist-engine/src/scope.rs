//! The values that expressions see, and the slots they are kept in.

use std::collections::HashMap;

use mist_format::{
    expr::{self, EvalError, Expr, Stack, Value},
    table::TableError,
};

use crate::DataFiles;

/// Names of a program and the slots of their values.
#[derive(Clone, Debug, Default)]
pub(crate) struct SlotNames {
    slots: HashMap<String, u32>,
    names: Vec<String>,
}

impl SlotNames {
    /// The slot of `name`; a new one at its first use.
    pub(crate) fn slot(&mut self, name: &str) -> u32 {
        if let Some(slot) = self.slots.get(name) {
            return *slot;
        }
        let slot = u32::try_from(self.names.len()).expect("fewer names than bytes of a program");
        self.slots.insert(name.to_owned(), slot);
        self.names.push(name.to_owned());
        slot
    }

    /// The slot of `name`, if it is known.
    pub(crate) fn find(&self, name: &str) -> Option<u32> {
        self.slots.get(name).copied()
    }

    /// The name in `slot`.
    pub(crate) fn name(&self, slot: u32) -> &str {
        &self.names[slot as usize]
    }

    /// How many slots there are.
    pub(crate) fn len(&self) -> usize {
        self.names.len()
    }
}

/// The values in the slots, and the tables that expressions read.
///
/// It notes when a slot came to hold another value than before, so that what depends on it is
/// computed again only then.
#[derive(Clone)]
pub(crate) struct SlotValues {
    values: Vec<Option<Value>>,
    /// For each slot the change, counted from 1, that gave it its value.
    changed: Vec<u64>,
    changes: u64,
    /// The slots of the last changes, in order; not more than there are slots.
    last: Vec<u32>,
    library: DataFiles,
}

impl SlotValues {
    pub(crate) fn new(slots: usize, library: DataFiles) -> Self {
        Self {
            values: vec![None; slots],
            changed: vec![0; slots],
            changes: 0,
            last: Vec::new(),
            library,
        }
    }

    pub(crate) fn set(&mut self, slot: u32, value: &Value) {
        self.put(slot, Some(value));
    }

    pub(crate) fn put(&mut self, slot: u32, value: Option<&Value>) {
        if !same(self.get(slot), value) {
            self.replace(slot, value.cloned());
        }
    }

    fn replace(&mut self, slot: u32, value: Option<Value>) {
        self.values[slot as usize] = value;
        self.note_change(slot);
    }

    #[inline]
    fn note_change(&mut self, slot: u32) {
        self.changes += 1;
        self.changed[slot as usize] = self.changes;
        if self.last.len() >= self.values.len() {
            self.last.clear();
        }
        self.last.push(slot);
    }

    /// [`SlotValues::set`] of one number.
    #[inline]
    pub(crate) fn set_number(&mut self, slot: u32, x: f64) {
        let held = self.values[slot as usize].as_mut().and_then(Value::single_mut);
        match held {
            Some(held) if held.to_bits() == x.to_bits() => {}
            Some(held) => {
                *held = x;
                self.note_change(slot);
            }
            None => self.replace(slot, Some(x.into())),
        }
    }

    pub(crate) fn get(&self, slot: u32) -> Option<&Value> {
        self.values.get(slot as usize)?.as_ref()
    }

    /// The number that `expr` gives the short way, if it does.
    pub(crate) fn short_number(&mut self, expr: &Expr, stack: &mut Stack) -> Option<f64> {
        expr.short_number(self, stack)
    }

    /// The time as the scope counts it: how many changes there were.
    pub(crate) fn now(&self) -> u64 {
        self.changes
    }

    /// Hands the slots that have changed since `then` to `visit`, some of them more than once.
    pub(crate) fn changed_since(&self, then: u64, mut visit: impl FnMut(u32)) {
        let count = (self.changes - then) as usize;
        match self.last.len().checked_sub(count) {
            Some(first) => self.last[first..].iter().copied().for_each(visit),
            None => {
                let slots = (0..).zip(&self.changed).filter(|(_, at)| **at > then);
                slots.for_each(|(slot, _)| visit(slot));
            }
        }
    }

    /// Whether none of `slots` has changed since `then`.
    pub(crate) fn is_same_since(&self, then: u64, slots: &[u32]) -> bool {
        slots.iter().all(|slot| self.changed.get(*slot as usize).is_none_or(|at| *at <= then))
    }

    pub(crate) fn value(&mut self, expr: &Expr, stack: &mut Stack) -> Result<Value, EvalError> {
        expr.eval(self, stack)
    }

    /// The last element of the value: what is taken wherever one number is wanted.
    pub(crate) fn number(&mut self, expr: &Expr, stack: &mut Stack) -> Result<f64, EvalError> {
        expr.number(self, stack)
    }

    /// Slots that hold a value.
    pub(crate) fn defined(&self) -> impl Iterator<Item = u32> {
        (0..).zip(&self.values).filter(|(_, value)| value.is_some()).map(|(slot, _)| slot)
    }
}

/// Something computed from variables, and when; it holds as long as they do not change.
pub(crate) struct Memo<T> {
    at: u64,
    pub(crate) value: T,
}

impl<T> Memo<T> {
    /// `value`, computed just now.
    pub(crate) fn new(scope: &SlotValues, value: T) -> Self {
        Self { at: scope.now(), value }
    }

    /// Whether what it was computed from, the slots `read`, is as it was.
    pub(crate) fn holds(&self, scope: &SlotValues, read: &[u32]) -> bool {
        scope.is_same_since(self.at, read)
    }
}

impl expr::Scope for SlotValues {
    fn variable(&self, slot: u32) -> Option<&[f64]> {
        self.values.get(slot as usize)?.as_ref().map(Value::as_slice)
    }

    #[inline]
    fn number(&self, slot: u32) -> Option<f64> {
        self.values.get(slot as usize)?.as_ref()?.single()
    }

    fn table(&mut self, file: &str, x: f64, column: i64) -> Result<f64, TableError> {
        self.library.columns(file)?.look_up(x, column)
    }
}

/// Whether two values have the same bits.
fn same(a: Option<&Value>, b: Option<&Value>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => {
            let (a, b) = (a.as_slice(), b.as_slice());
            let mut pairs = a.iter().zip(b);
            a.len() == b.len() && pairs.all(|(a, b)| a.to_bits() == b.to_bits())
        }
        (None, None) => true,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use mist_format::Dialect;

    use super::*;
    use crate::MemoryFiles;

    #[test]
    fn changes_are_told_however_many_there_are() {
        let library = DataFiles::new(Arc::new(MemoryFiles::default()), Dialect::Sound);
        let mut scope = SlotValues::new(4, library);
        for (then, rounds) in [(0, 1), (2, 1), (2, 3), (9, 2), (13, 0)] {
            for round in 0..rounds {
                for slot in [3, 1] {
                    scope.set_number(slot, f64::from(100 * round + slot) + then as f64);
                }
            }
            let mut told = Vec::new();
            scope.changed_since(then, |slot| told.push(slot));
            told.sort_unstable();
            told.dedup();
            let all = (0..4).filter(|slot| !scope.is_same_since(then, &[*slot]));
            assert_eq!(told, all.collect::<Vec<_>>(), "since {then}");
        }
    }

    #[test]
    fn only_another_value_is_a_change() {
        let library = DataFiles::new(Arc::new(MemoryFiles::default()), Dialect::Sound);
        let mut scope = SlotValues::new(2, library);
        scope.set_number(0, 0.0);
        scope.set_number(1, f64::NAN);
        let then = scope.now();
        scope.set_number(0, 0.0);
        scope.set_number(1, f64::NAN);
        assert!(scope.is_same_since(then, &[0, 1, u32::MAX]));
        scope.set(0, &(-0.0).into());
        assert!(!scope.is_same_since(then, &[1, 0]) && scope.is_same_since(then, &[1]));
        scope.put(1, None);
        assert!(!scope.is_same_since(then, &[1]));
    }
}
