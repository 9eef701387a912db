//! The values that expressions see, and the slots they are kept in.

use std::collections::HashMap;

use mist_format::{
    expr::{self, EvalError, Expr, OperandStack, Value},
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

    /// Number of slots.
    pub(crate) fn len(&self) -> usize {
        self.names.len()
    }
}

/// The values in the slots, and the tables that expressions read.
#[derive(Clone)]
pub(crate) struct SlotValues {
    values: Vec<Option<Value>>,
    library: DataFiles,
}

impl SlotValues {
    pub(crate) fn new(slots: usize, library: DataFiles) -> Self {
        Self { values: vec![None; slots], library }
    }

    /// Puts `value` into `slot`; returns whether it differs in any bit from the one before.
    pub(crate) fn put(&mut self, slot: u32, value: Option<&Value>) -> bool {
        let changes = !same(self.get(slot), value);
        if changes {
            self.values[slot as usize] = value.cloned();
        }
        changes
    }

    /// [`SlotValues::put`] of one number.
    #[inline]
    pub(crate) fn set_number(&mut self, slot: u32, x: f64) -> bool {
        match self.values[slot as usize].as_mut().and_then(Value::single_mut) {
            Some(held) if held.to_bits() == x.to_bits() => false,
            Some(held) => {
                *held = x;
                true
            }
            None => {
                self.values[slot as usize] = Some(x.into());
                true
            }
        }
    }

    pub(crate) fn get(&self, slot: u32) -> Option<&Value> {
        self.values.get(slot as usize)?.as_ref()
    }

    /// The number of an expression that has one without general evaluation.
    #[inline]
    pub(crate) fn short_number(&mut self, expr: &Expr, stack: &mut OperandStack) -> Option<f64> {
        expr.short_number(self, stack)
    }

    pub(crate) fn value(
        &mut self,
        expr: &Expr,
        stack: &mut OperandStack,
    ) -> Result<Value, EvalError> {
        expr.eval(self, stack)
    }

    /// The last element of the value: what is taken wherever one number is wanted.
    pub(crate) fn number(
        &mut self,
        expr: &Expr,
        stack: &mut OperandStack,
    ) -> Result<f64, EvalError> {
        expr.number(self, stack)
    }

    /// Slots that hold a value.
    pub(crate) fn defined(&self) -> impl Iterator<Item = u32> {
        (0..).zip(&self.values).filter(|(_, value)| value.is_some()).map(|(slot, _)| slot)
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

/// True if two values have the same bits.
pub(crate) fn same(a: Option<&Value>, b: Option<&Value>) -> bool {
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
    fn only_another_value_is_a_change() {
        let library = DataFiles::new(Arc::new(MemoryFiles::default()), Dialect::Sound);
        let mut values = SlotValues::new(2, library);
        assert!(values.set_number(0, 0.0) && values.set_number(1, f64::NAN));
        assert!(!values.set_number(0, 0.0) && !values.set_number(1, f64::NAN));
        assert!(values.put(0, Some(&(-0.0).into())));
        assert!(values.put(1, None) && !values.put(1, None));
    }
}
