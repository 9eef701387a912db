//! `LIST file`: one row per value.
//!
//! A cell is evaluated when its row is activated, with the variables of the step before; its value
//! becomes the content of the entry, under compat as a text of sixteen digits. The results show the
//! cell's own expression, evaluated again with the new variables.

use std::sync::Arc;

use mist_format::{
    Diagnostic,
    expr::{Expr, Value},
    number::whole_number,
};
use scattering::Mode;

use super::content::{EntryContent, LoopContext, LoopWrite};
use crate::{deviation::dialect, fault::Fault, plan::ListPlan, step::LoopCell};

/// The position of a LIST loop.
pub(crate) struct ListState {
    row: usize,
    cells: Vec<LoopCell>,
}

impl ListState {
    /// At the first row.
    pub(crate) fn start() -> Self {
        Self { row: 0, cells: Vec::new() }
    }

    /// Goes to the next row; false behind the last one.
    pub(crate) fn advance(&mut self, plan: &ListPlan) -> bool {
        self.row += 1;
        self.row < plan.file.row_count()
    }

    pub(crate) fn cells(&self) -> &[LoopCell] {
        &self.cells
    }

    pub(crate) fn fraction(&self, plan: &ListPlan) -> f64 {
        self.row as f64 / plan.file.row_count() as f64
    }

    /// Writes the row into its entries and columns.
    pub(crate) fn write(
        &mut self,
        plan: &ListPlan,
        context: &mut LoopContext<'_, '_>,
        written: &mut Vec<LoopWrite>,
    ) -> Result<(), Fault> {
        self.cells.clear();
        for (at, column) in plan.columns.iter().enumerate() {
            let raw = plan.file.cell(self.row, at);
            let (content, cell) = if column.is_text {
                (EntryContent::Text(raw.into()), LoopCell::Text(raw.into()))
            } else {
                let (value, cell) = evaluate(plan, raw, self.row, context)?;
                (content(value, context.mode), cell)
            };
            written.push(LoopWrite { entry: column.entry, content });
            self.cells.push(cell);
        }
        Ok(())
    }
}

/// The content that a value becomes: under compat the number that NIST's program reads in its
/// text, or the text. A value that is not finite is text, which is not a number: the step is refused.
fn content(value: Value, mode: Mode) -> EntryContent {
    if mode == Mode::Sound && value.as_slice().iter().all(|x| x.is_finite()) {
        return EntryContent::Value(value);
    }
    let text = value.to_text();
    match whole_number(&text) {
        Some(x) => EntryContent::Value(x.into()),
        None => EntryContent::Text(text.into()),
    }
}

/// The value of a cell, and what the results show.
fn evaluate(
    plan: &ListPlan,
    raw: &str,
    row: usize,
    context: &mut LoopContext<'_, '_>,
) -> Result<(Value, LoopCell), Fault> {
    if let Some(x) = whole_number(raw) {
        return Ok((x.into(), LoopCell::of(x)));
    }
    let name = plan.statement.file.as_str();
    let wrong = |diagnostic: Diagnostic| {
        let place = format!("row {} of {name}: {}", row + 1, diagnostic.message);
        Box::new(Diagnostic { span: plan.statement.span, message: place, ..diagnostic })
    };
    let mut expr =
        Expr::compile(raw, dialect(context.mode)).map_err(|error| wrong(error.diagnostic()))?;
    // A name that no entry and no result has stays without a slot: unknown when it is evaluated.
    expr.bind(|name| context.plan.names.find(name).unwrap_or(u32::MAX));
    let value = context
        .values
        .evaluate_raw(&expr)
        .map_err(|error| wrong(error.diagnostic(context.values.known())))?;
    Ok((value, LoopCell::Expression(Arc::new(expr))))
}
