//! The result of compiling an expression.

use super::op::Operation;
use super::scalar::Code;

/// An expression as operations on a stack.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CompiledExpr {
    pub(super) text: String,
    pub(super) steps: Vec<Operation>,
    /// The short program that replaces the steps while every name holds one number.
    pub(super) short: Option<Vec<Code>>,
    pub(super) names: Vec<String>,
    pub(super) slots: Vec<u32>,
    pub(super) files: Vec<String>,
    pub(super) calls: Vec<String>,
}
