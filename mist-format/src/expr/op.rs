//! The postfix program of an expression and the table of its operators.

use super::functions::Function;
use crate::dialect::TextDeviation;
use crate::span::Span;

/// A binary operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Op {
    Comma,
    Or,
    And,
    Less,
    Greater,
    Equal,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
}

impl Op {
    /// The operator that this character is, and how tightly it binds; all bind from the left.
    const TABLE: &'static [(u8, Self, u8)] = &[
        (b',', Self::Comma, 0),
        (b'|', Self::Or, 1),
        (b'&', Self::And, 1),
        (b'<', Self::Less, 2),
        (b'>', Self::Greater, 2),
        (b'=', Self::Equal, 2),
        (b'+', Self::Add, 3),
        (b'-', Self::Subtract, 3),
        (b'*', Self::Multiply, 5),
        (b'/', Self::Divide, 5),
        (b'^', Self::Power, 6),
    ];

    pub(super) fn find(byte: u8) -> Option<Self> {
        Self::TABLE.iter().find(|row| row.0 == byte).map(|row| row.1)
    }

    pub(super) fn power(self) -> u8 {
        Self::TABLE.iter().find(|row| row.1 == self).map_or(0, |row| row.2)
    }

    /// The value; a comma has none of its own.
    pub(super) fn apply(self, a: f64, b: f64) -> f64 {
        let truth = |yes: bool| f64::from(u8::from(yes));
        match self {
            Self::Comma => b,
            Self::Or => truth(a != 0.0 || b != 0.0),
            Self::And => truth(a != 0.0 && b != 0.0),
            Self::Less => truth(a < b),
            Self::Greater => truth(a > b),
            Self::Equal => truth(a == b),
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply => a * b,
            Self::Divide => a / b,
            // The square rounded once, as exact as a power can be.
            Self::Power if b == 2.0 => a * a,
            Self::Power => a.powf(b),
        }
    }
}

/// One step of the postfix program, and its part of the text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Operation {
    pub(super) action: Action,
    pub(super) span: Span,
}

/// The action of a step. Values are on a stack; elements beyond the first of each value are in
/// the list of the frame, as in NIST's evaluator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Action {
    /// Pushes a number.
    Number(f64),
    /// Pushes a variable.
    Variable { name: u32, negative: bool, only_scalar: Option<TextDeviation> },
    /// Replaces the upper two numbers.
    Binary(Op),
    /// Moves the upper number to the list.
    Comma,
    /// Opens a frame for a parenthesis or for arguments.
    Open,
    /// Closes the frame and pushes what it holds.
    Group { negative: bool, only_scalar: Option<TextDeviation> },
    /// Closes the frame and pushes the function of what it holds.
    Call { function: Option<Function>, call: u32, negative: bool },
    /// Closes the frame and pushes the look-up in a file.
    File { file: u32, negative: bool, library: bool },
    /// A file without arguments: always an error.
    BareFile { file: u32 },
}
