//! Real functions of one variable given by expressions of the library's evaluator.

use std::{fmt, sync::Arc};

use mist_format::{
    expr::{self, Expr, OperandStack},
    table::TableError,
};
use scattering::{optics::FormulaFn, spec::ParameterKind};

use super::error::SetError;
use crate::DataFiles;

/// A function of `x` with the text it came from.
#[derive(Clone)]
pub(crate) struct FormulaState {
    text: Arc<str>,
    function: FormulaFn,
}

impl PartialEq for FormulaState {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

impl Eq for FormulaState {}

impl fmt::Debug for FormulaState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl FormulaState {
    /// A number that does not depend on x.
    pub(crate) fn constant(value: f64) -> Self {
        Self {
            text: ParameterKind::Formula(value).default_text().into(),
            function: Arc::new(move |_| value),
        }
    }

    /// The function that `text` says.
    pub(crate) fn read(text: &str, library: &DataFiles) -> Result<Self, SetError> {
        let expr = Expr::compile_library(text)
            .map_err(|error| SetError::value(format!("{text:?}: {error}")))?;
        Ok(Self { text: text.into(), function: columns(&expr, "x", 0, library)? })
    }

    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    pub(crate) fn function(&self) -> FormulaFn {
        self.function.clone()
    }
}

/// Element `element` of the value of `expr` as a function of `variable`; 0 where there is none.
///
/// It is evaluated once, so that names and files that do not exist are told here; where it
/// fails later, it is not a number.
pub(crate) fn columns(
    expr: &Expr,
    variable: &str,
    element: usize,
    library: &DataFiles,
) -> Result<FormulaFn, SetError> {
    let text = expr.text();
    if let Some(name) = expr.names().iter().find(|name| *name != variable) {
        let problem = format!("{text:?} reads {name}, which is not its variable {variable}");
        return Err(SetError::value(problem));
    }
    let scope = Variable { x: [0.5], library: library.clone() };
    expr.eval(&mut scope.clone(), &mut OperandStack::default())
        .map_err(|error| SetError::value(format!("{text:?}: {error}")))?;
    let expr = expr.clone();
    Ok(Arc::new(move |x| {
        let mut scope = Variable { x: [x], library: scope.library.clone() };
        expr.eval(&mut scope, &mut OperandStack::default())
            .map_or(f64::NAN, |value| value.as_slice().get(element).copied().unwrap_or(0.0))
    }))
}

/// The one variable.
#[derive(Clone)]
struct Variable {
    x: [f64; 1],
    library: DataFiles,
}

impl expr::Scope for Variable {
    fn variable(&self, _: u32) -> Option<&[f64]> {
        Some(&self.x)
    }

    fn table(&mut self, file: &str, x: f64, column: i64) -> Result<f64, TableError> {
        self.library.columns(file)?.look_up(x, column)
    }
}
