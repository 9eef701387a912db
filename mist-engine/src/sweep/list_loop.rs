//! `LIST file`: one row per value.
//!
//! A cell is evaluated when its row is activated, with the variables of the step before; its
//! 16-digit text becomes the text of the entry. The results show the cell's own expression,
//! evaluated again with the new variables.

use std::sync::Arc;

use mist_format::{
    Diagnostic,
    expr::{Expr, Value},
    number::whole_number,
    program::ListLoop,
    table::ListTable,
};

use super::{EntryContent, LoopContext, LoopWrite};
use crate::{fault::Fault, quirk::dialect, step::LoopCell};

/// A LIST loop as compiled.
pub(crate) struct ListPlan {
    pub(crate) statement: ListLoop,
    pub(crate) file: Arc<ListTable>,
    pub(crate) columns: Vec<ListColumn>,
    /// Whether a cell reads results of earlier steps.
    pub(crate) fed_back: bool,
}

/// A column of a LIST file.
pub(crate) struct ListColumn {
    /// The entry of VARIABLES that it writes.
    pub(crate) entry: usize,
    /// The name in the file.
    pub(crate) title: String,
    /// Whether the entry is a text for the model.
    pub(crate) is_text: bool,
}

/// Where a LIST loop stands.
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
        context: &mut LoopContext<'_>,
        written: &mut Vec<LoopWrite>,
    ) -> Result<(), Fault> {
        self.cells.clear();
        for (at, column) in plan.columns.iter().enumerate() {
            let raw = plan.file.cell(self.row, at);
            let (text, cell) = if column.is_text {
                (Arc::from(raw), LoopCell::Text(raw.into()))
            } else {
                let (text, cell) = evaluate(plan, raw, self.row, context)?;
                (text.into(), cell)
            };
            let number = whole_number(&text).filter(|_| !column.is_text);
            let content = number.map_or(EntryContent::Text(text), EntryContent::Number);
            written.push(LoopWrite { entry: column.entry, content });
            self.cells.push(cell);
        }
        Ok(())
    }
}

/// The text that a cell gives its entry, and what the results show.
fn evaluate(
    plan: &ListPlan,
    raw: &str,
    row: usize,
    context: &mut LoopContext<'_>,
) -> Result<(String, LoopCell), Fault> {
    if let Some(x) = whole_number(raw) {
        return Ok((Value::from(x).to_text(), LoopCell::of(x)));
    }
    let name = plan.statement.file.as_str();
    let wrong = |diagnostic: Diagnostic| {
        let place = format!("row {} of {name}: {}", row + 1, diagnostic.message);
        Box::new(Diagnostic { span: plan.statement.span, message: place, ..diagnostic })
    };
    let mut expr =
        Expr::compile(raw, dialect(context.mode)).map_err(|error| wrong(error.diagnostic()))?;
    // A name that no entry and no result has stays without a slot: unknown when it is evaluated.
    expr.bind(|name| context.names.find(name).unwrap_or(u32::MAX));
    let value = context.scope.value(&expr, context.stack).map_err(|error| {
        let known: Vec<&str> = context.scope.defined().map(|s| context.names.name(s)).collect();
        wrong(error.diagnostic(known))
    })?;
    Ok((value.to_text(), LoopCell::Expression(Arc::new(expr))))
}
