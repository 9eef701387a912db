//! The frames of the scan.

use crate::dialect::TextDeviation;
use crate::expr::op::Op;

/// An open parenthesis, or the whole expression.
pub(super) struct OpenFrame {
    pub(super) kind: FrameKind,
    pub(super) negative: bool,
    /// Start of the operand.
    pub(super) start: usize,
    /// Position of its parenthesis.
    pub(super) parenthesis: usize,
    /// Operators without their right operand, with their positions.
    pub(super) pending: Vec<(Op, usize)>,
    /// Numbers on the value stack.
    pub(super) values: usize,
    /// Steps that may push vectors.
    pub(super) vectors: Vec<usize>,
    /// The deviation of NIST's program for operators on these vectors, if there are any.
    pub(super) binding: Option<TextDeviation>,
}

impl OpenFrame {
    /// A frame without operands.
    pub(super) fn new(kind: FrameKind, negative: bool, start: usize, parenthesis: usize) -> Self {
        let (pending, vectors) = (Vec::new(), Vec::new());
        Self { kind, negative, start, parenthesis, pending, values: 0, vectors, binding: None }
    }
}

/// The kind of a frame.
#[derive(Clone, Copy)]
pub(super) enum FrameKind {
    Group,
    Call(u32),
    File(u32),
}
