//! An expression: compiled from its text, evaluated with a scope.

use super::compiled::CompiledExpr;
use super::error::{EvalError, ExprError};
use super::eval::OperandStack;
use super::scalar;
use super::scan::{Rules, compile};
use super::scope::Scope;
use super::value::Value;
use crate::dialect::Dialect;

/// A compiled expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr(CompiledExpr);

impl Expr {
    /// Compiles an expression of the program language.
    ///
    /// Names are not looked up: an unknown one is an error of the evaluation.
    ///
    /// # Errors
    /// Texts that are not an expression, texts that the sound dialect refuses, and more than
    /// [`MAX_TOKENS`](super::MAX_TOKENS) operands, operators and parentheses.
    pub fn compile(text: &str, dialect: Dialect) -> Result<Self, ExprError> {
        compile(text, Rules::program(dialect)).map(Self)
    }

    /// Compiles an expression of the library's evaluator, as used by tables, formula files and
    /// `Equation_Reflectance`: white space is ignored, two operands need an operator,
    /// several elements are allowed at the top only.
    ///
    /// # Errors
    /// As for [`Expr::compile`].
    pub fn compile_library(text: &str) -> Result<Self, ExprError> {
        compile(text, Rules::library()).map(Self)
    }

    /// The text it was compiled from.
    pub fn text(&self) -> &str {
        &self.0.text
    }

    /// The variables it reads (also `#x`), each once, in the order of their first use.
    pub fn names(&self) -> &[String] {
        &self.0.names
    }

    /// The files that `@file(…)` reads, each once, without the `@`.
    pub fn files(&self) -> &[String] {
        &self.0.files
    }

    /// Sets the slot of each of [`Expr::names`] in the scope of the evaluations. Without it, the
    /// slots are the indices in that list.
    pub fn bind(&mut self, mut slot: impl FnMut(&str) -> u32) {
        self.0.slots = self.0.names.iter().map(|name| slot(name)).collect();
        self.0.short = scalar::shorten(&self.0.steps, &self.0.files, &self.0.slots);
    }

    /// The slots given by [`Expr::bind`], parallel to [`Expr::names`].
    pub fn slots(&self) -> &[u32] {
        &self.0.slots
    }

    /// Computes the value.
    ///
    /// # Errors
    /// Names that the scope does not know, functions with a wrong number of arguments, files
    /// that cannot be read; under the sound rules vectors where a single number is needed.
    pub fn eval(
        &self,
        scope: &mut impl Scope,
        stack: &mut OperandStack,
    ) -> Result<Value, EvalError> {
        match self.short_number(scope, stack) {
            Some(x) => Ok(x.into()),
            None => stack.run(&self.0, scope).map(|(first, rest)| Value::new(first, rest)),
        }
    }

    /// Computes the number that NIST's program takes from the value: its **last** element.
    ///
    /// # Errors
    /// As for [`Expr::eval`].
    pub fn number(
        &self,
        scope: &mut impl Scope,
        stack: &mut OperandStack,
    ) -> Result<f64, EvalError> {
        match self.short_number(scope, stack) {
            Some(x) => Ok(x),
            None => {
                stack.run(&self.0, scope).map(|(first, rest)| rest.last().copied().unwrap_or(first))
            }
        }
    }

    /// Computes the value by the short program, if it is a single number of single numbers and
    /// nothing fails; otherwise use [`Expr::eval`].
    pub fn short_number(&self, scope: &mut impl Scope, stack: &mut OperandStack) -> Option<f64> {
        self.0
            .short
            .as_ref()
            .and_then(|code| scalar::run(code, &self.0.files, scope, &mut stack.memo))
    }

    /// Removes the short program, so that tests reach the general machine; true if there was one.
    #[cfg(test)]
    pub(super) fn without_short_program(&mut self) -> bool {
        self.0.short.take().is_some()
    }
}
