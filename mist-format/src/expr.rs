//! Expressions: compiled once into a postfix program, evaluated as often as wanted.
//!
//! NIST's evaluator is one scan over the text, not a grammar; [`Expr::compile`] does that scan
//! (see `scan.rs`) and notes what it would compute. Values are vectors of at least one number.
//!
//! ```
//! use mist_format::{Dialect, expr::{Expr, NoNames, Stack}};
//! let area = Expr::compile("4*atan(1)*2^2", Dialect::Sound).unwrap();
//! let value = area.number(&mut NoNames, &mut Stack::default()).unwrap();
//! assert!((value - 4.0 * std::f64::consts::PI).abs() < 1e-15);
//! ```

mod error;
mod eval;
mod functions;
mod memo;
mod op;
mod scalar;
mod scan;
mod value;

pub use error::{EvalError, EvalErrorKind, ExprError, ExprErrorKind};
pub use eval::{NoNames, Scope, Stack};
pub use functions::Function;
pub use scan::MAX_TOKENS;
pub use value::Value;

use crate::dialect::Dialect;
use op::Operation;

/// A compiled expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    text: String,
    steps: Vec<Operation>,
    /// What is run instead of the steps as long as every name holds one number.
    short: Option<Vec<scalar::Code>>,
    names: Vec<String>,
    slots: Vec<u32>,
    files: Vec<String>,
    calls: Vec<String>,
}

impl Expr {
    /// Compiles an expression of the program language.
    ///
    /// Names are not looked up: an unknown one is an error of the evaluation.
    ///
    /// # Errors
    /// What is no expression, what the sound dialect refuses, and more than [`MAX_TOKENS`]
    /// operands, operators and parentheses.
    pub fn compile(text: &str, dialect: Dialect) -> Result<Self, ExprError> {
        scan::compile(text, scan::Rules::program(dialect))
    }

    /// Compiles an expression of the library's evaluator, as used by tables, formula files and
    /// `Equation_Reflectance`: white space means nothing, two operands need an operator,
    /// several elements are allowed at the top only.
    ///
    /// # Errors
    /// As for [`Expr::compile`].
    pub fn compile_library(text: &str) -> Result<Self, ExprError> {
        scan::compile(text, scan::Rules::library())
    }

    /// The text it was compiled from.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The variables it reads (also `#x`), each once, in the order of their first use.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The files that `@file(…)` reads, each once, without the `@`.
    pub fn files(&self) -> &[String] {
        &self.files
    }

    /// Says under which slot the scope of the evaluations keeps each of [`Expr::names`].
    /// Without it, the slots are the places in that list.
    pub fn bind(&mut self, mut slot: impl FnMut(&str) -> u32) {
        self.slots = self.names.iter().map(|name| slot(name)).collect();
        self.short = scalar::shorten(&self.steps, &self.files, &self.slots);
    }

    /// The slots given by [`Expr::bind`], parallel to [`Expr::names`].
    pub fn slots(&self) -> &[u32] {
        &self.slots
    }

    /// Computes the value.
    ///
    /// # Errors
    /// Names that the scope does not know, functions with a wrong number of arguments, files
    /// that cannot be read; under the sound rules vectors where a single number is needed.
    pub fn eval(&self, scope: &mut impl Scope, stack: &mut Stack) -> Result<Value, EvalError> {
        match self.short_number(scope, stack) {
            Some(x) => Ok(x.into()),
            None => stack.run(self, scope).map(|(first, rest)| Value::new(first, rest)),
        }
    }

    /// Computes the number that NIST's program takes from the value: its **last** element.
    ///
    /// # Errors
    /// As for [`Expr::eval`].
    pub fn number(&self, scope: &mut impl Scope, stack: &mut Stack) -> Result<f64, EvalError> {
        match self.short_number(scope, stack) {
            Some(x) => Ok(x),
            None => {
                stack.run(self, scope).map(|(first, rest)| rest.last().copied().unwrap_or(first))
            }
        }
    }

    /// Computes the value the short way, if it is a single number of single numbers and nothing
    /// fails; else [`Expr::eval`] finds out.
    pub fn short_number(&self, scope: &mut impl Scope, stack: &mut Stack) -> Option<f64> {
        self.short.as_ref().and_then(|code| scalar::run(code, &self.files, scope, &mut stack.memo))
    }
}

#[cfg(test)]
mod tests;
