//! Expressions, compiled once into a postfix program and evaluated many times.
//!
//! NIST's evaluator is one scan over the text, not a grammar; [`Expr::compile`] does that scan
//! (see `scan.rs`) and records its operations. Values are vectors of at least one number.
//!
//! ```
//! use mist_format::{Dialect, expr::{Expr, NoNames, OperandStack}};
//! let area = Expr::compile("4*atan(1)*2^2", Dialect::Sound).unwrap();
//! let value = area.number(&mut NoNames, &mut OperandStack::default()).unwrap();
//! assert!((value - 4.0 * std::f64::consts::PI).abs() < 1e-15);
//! ```

mod compiled;
mod error;
mod eval;
mod expression;
mod functions;
mod limits;
mod memo;
mod op;
mod scalar;
mod scan;
mod scope;
mod value;

pub use error::{EvalError, EvalErrorKind, ExprError, ExprErrorKind};
pub use eval::OperandStack;
pub use expression::Expr;
pub use functions::Function;
pub use limits::MAX_TOKENS;
pub use scope::{NoNames, Scope};
pub use value::Value;

#[cfg(test)]
mod tests;
