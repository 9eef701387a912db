//! Limits of expressions.

/// Maximum number of operands, operators and parentheses of an expression.
pub const MAX_TOKENS: usize = 100_000;
