//! Binding of names and expressions while a program is compiled.

use mist_format::{Diagnostic, expr::Expr, program::SourceText};
use scattering::Mode;

use crate::{
    DataFiles,
    deviation::dialect,
    fault::{Fault, placed},
    plan::ExpressionId,
    slots::SlotNames,
};

/// The names, the shared expressions and the faults found so far.
pub(super) struct Binder<'a> {
    pub(super) mode: Mode,
    pub(super) library: &'a DataFiles,
    pub(super) names: SlotNames,
    pub(super) expressions: Vec<Expr>,
    pub(super) faults: Vec<Diagnostic>,
}

impl<'a> Binder<'a> {
    /// Without any names.
    pub(super) fn new(mode: Mode, library: &'a DataFiles) -> Self {
        let (names, expressions, faults) = (SlotNames::default(), Vec::new(), Vec::new());
        Self { mode, library, names, expressions, faults }
    }

    /// Keeps a fault; the compilation goes on to find others.
    pub(super) fn note(&mut self, fault: Diagnostic) {
        self.faults.push(fault);
    }

    /// Compiles `text` and binds its names to slots.
    pub(super) fn expr(&mut self, text: &SourceText) -> Result<Expr, Fault> {
        let mut expr = Expr::compile(text.as_str(), dialect(self.mode))
            .map_err(|error| placed(text, error.diagnostic()))?;
        let names = &mut self.names;
        expr.bind(|name| names.slot(name));
        Ok(expr)
    }

    /// [`Binder::expr`]; a fault is noted.
    pub(super) fn expr_or_note(&mut self, text: &SourceText) -> Option<Expr> {
        self.expr(text).map_err(|fault| self.faults.push(*fault)).ok()
    }

    /// The id of the expression `text` among those that share a memo; a fault is noted.
    pub(super) fn expression_or_note(&mut self, text: &SourceText) -> Option<ExpressionId> {
        let expr = self.expr_or_note(text)?;
        Some(self.share(expr))
    }

    /// The id of `expr`: that of an equal one, or a new one.
    pub(super) fn share(&mut self, expr: Expr) -> ExpressionId {
        let known = self.expressions.iter().position(|known| known.text() == expr.text());
        ExpressionId(known.unwrap_or_else(|| {
            self.expressions.push(expr);
            self.expressions.len() - 1
        }))
    }
}
