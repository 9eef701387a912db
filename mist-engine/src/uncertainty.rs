//! Positions of the estimated errors of integrals in the table.
//!
//! The column NAME.error of the integral NAME stands directly after the first output that shows
//! this integral and nothing else; errors of integrals that no output shows so stand after all
//! outputs, in the order of the program. Expressions of outputs may use NAME.error.

use crate::plan::{ErrorColumn, ErrorColumns, IntegralPlan, OutputPlan};

impl ErrorColumns {
    /// One column per name of an integral.
    pub(crate) fn new(
        integrals: &[IntegralPlan],
        outputs: &[OutputPlan],
        mut slot: impl FnMut(&str) -> u32,
    ) -> Self {
        let mut columns = Vec::new();
        for (at, integral) in integrals.iter().enumerate() {
            // Of two integrals of one name the later value counts.
            if integrals[at + 1..].iter().any(|later| later.slot == integral.slot) {
                continue;
            }
            let name = integral.name.as_str();
            let shows = |output: &OutputPlan| output.text.as_str().trim() == name;
            let title = format!("{name}.error");
            let after = outputs.iter().position(shows);
            columns.push(ErrorColumn { slot: slot(&title), title, integral: at, after });
        }
        Self(columns)
    }

    /// All columns, in the order of the integrals.
    pub(crate) fn all(&self) -> impl Iterator<Item = &ErrorColumn> {
        self.0.iter()
    }

    /// Slots in which expressions find them.
    pub(crate) fn slots(&self) -> impl Iterator<Item = u32> {
        self.0.iter().map(|column| column.slot)
    }

    /// The columns directly after the output number `at`.
    pub(crate) fn after(&self, at: usize) -> impl Iterator<Item = &ErrorColumn> {
        self.0.iter().filter(move |column| column.after == Some(at))
    }

    /// The columns after all outputs.
    pub(crate) fn last(&self) -> impl Iterator<Item = &ErrorColumn> {
        self.0.iter().filter(|column| column.after.is_none())
    }
}
