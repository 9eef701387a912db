//! The values that expressions see, and the slots they are kept in.

use std::collections::HashMap;

use mist_format::{
    expr::{self, EvalError, Expr, Stack, Value},
    table::TableError,
};

use crate::Library;

/// Names of a program and the slots of their values.
#[derive(Clone, Debug, Default)]
pub(crate) struct Names {
    slots: HashMap<String, u32>,
    names: Vec<String>,
}

impl Names {
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
#[derive(Clone)]
pub(crate) struct Scope {
    values: Vec<Option<Value>>,
    library: Library,
}

impl Scope {
    pub(crate) fn new(slots: usize, library: Library) -> Self {
        Self { values: vec![None; slots], library }
    }

    pub(crate) fn set(&mut self, slot: u32, value: Value) {
        self.values[slot as usize] = Some(value);
    }

    pub(crate) fn put(&mut self, slot: u32, value: Option<Value>) {
        self.values[slot as usize] = value;
    }

    pub(crate) fn get(&self, slot: u32) -> Option<&Value> {
        self.values.get(slot as usize)?.as_ref()
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

impl expr::Scope for Scope {
    fn variable(&self, slot: u32) -> Option<&[f64]> {
        self.values.get(slot as usize)?.as_ref().map(Value::as_slice)
    }

    fn table(&mut self, file: &str, x: f64, column: i64) -> Result<f64, TableError> {
        self.library.columns(file)?.look_up(x, column)
    }
}
