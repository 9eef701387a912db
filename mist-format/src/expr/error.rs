//! Errors of expressions: of their text and of their evaluation.

use super::functions::Function;
use super::limits::MAX_TOKENS;
use crate::diagnostic::Diagnostic;
use crate::dialect::TextDeviation;
use crate::span::Span;
use crate::suggestion::did_you_mean;
use crate::table::TableError;

/// An error of the text of an expression.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{kind}")]
pub struct ExprError {
    /// Location in the text.
    pub span: Span,
    /// The kind of error.
    pub kind: ExprErrorKind,
}

/// Kinds of errors of a text. NIST's program reports most of them as `Invalid value`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ExprErrorKind {
    /// Nothing, blanks or a closing parenthesis where an operand should be.
    #[error("a value is missing here")]
    MissingValue,
    /// A blank behind the last operand.
    #[error("a blank ends the expression")]
    TrailingBlank,
    /// A character that begins no operand.
    #[error("`{found}` is not a value")]
    InvalidValue {
        /// The character.
        found: char,
    },
    /// A number that does not fit, such as `1e400`, or is not finished, such as `1e`.
    #[error("`{text}` is not a number")]
    InvalidNumber {
        /// The incomplete number.
        text: String,
    },
    /// A character that is not an operator (library evaluator only).
    #[error("`{found}` is not an operator")]
    InvalidOperator {
        /// The character.
        found: char,
    },
    /// A parenthesis without its partner.
    #[error("mismatched parentheses")]
    Parentheses {
        /// True for `(`.
        opening: bool,
    },
    /// NIST's program reads something else than what is written.
    #[error("{}", refusal(*deviation))]
    Refused {
        /// The deviation of NIST's program.
        deviation: TextDeviation,
    },
    /// A number with a unit behind it.
    #[error("a number has no unit")]
    Unit {
        /// The remedy.
        help: String,
    },
    /// More than [`MAX_TOKENS`] operands, operators and parentheses.
    #[error("the expression has more than {} operands and operators", MAX_TOKENS)]
    TooLong,
}

fn refusal(deviation: TextDeviation) -> &'static str {
    match deviation {
        TextDeviation::OperatorLostToBlanks => "too many blanks before an operator",
        TextDeviation::AdjacentOperands => "an operator is missing between two values",
        TextDeviation::SignLost => "a sign that NIST's program loses",
        TextDeviation::SignBindsToNumber => "a minus behind blanks in front of a power",
        TextDeviation::NumberJunk => "an unfinished number",
        TextDeviation::VectorArithmetic => "arithmetic with a vector of several elements",
        TextDeviation::NestedLists => "a list inside a list",
        _ => "a reading of NIST's program that is refused",
    }
}

/// The reading of NIST's program, and the remedy.
fn explain(deviation: TextDeviation) -> (&'static str, &'static str) {
    match deviation {
        TextDeviation::OperatorLostToBlanks => (
            "NIST's program overlooks this operator and goes on with the next value alone",
            "leave at most one blank before the operator",
        ),
        TextDeviation::AdjacentOperands => (
            "NIST's program forgets the first of the two values",
            "write an operator, such as `*`, between them",
        ),
        TextDeviation::SignLost => (
            "NIST's program reads this sign with a number that does not follow, and loses it",
            "write the sign directly before the name, with parentheses behind another sign",
        ),
        TextDeviation::SignBindsToNumber => (
            "NIST's program takes the minus into the number first: `  -2^2` is 4, `-2^2` is -4",
            "write (-2)^2 or -(2^2)",
        ),
        TextDeviation::NumberJunk => (
            "NIST's program drops what looks like the beginning of a number and reads on",
            "finish the number, or write an operator between it and the name",
        ),
        TextDeviation::VectorArithmetic => (
            "NIST's program computes with the first element only and appends the others",
            "write the elements out, such as (2*a,2*b)",
        ),
        TextDeviation::NestedLists => (
            "NIST's program joins the lists in another order than written",
            "write one list without inner parentheses",
        ),
        _ => ("NIST's program reads something else than what is written", "write it plainly"),
    }
}

impl ExprError {
    /// The error for people; the span is that of the expression's text.
    pub fn diagnostic(&self) -> Diagnostic {
        let found = |code| Diagnostic::error(code, self.span, self.to_string());
        let invalid = "NIST's program says `Invalid value`";
        match &self.kind {
            ExprErrorKind::MissingValue => found("expr/missing-value")
                .help("write a number, a name or a parenthesis")
                .note(invalid),
            ExprErrorKind::TrailingBlank => {
                found("expr/trailing-blank").help("remove the blank").note(invalid)
            }
            ExprErrorKind::InvalidValue { found: '!' | '%' | '~' } => found("expr/invalid-value")
                .help(
                    "the operators are + - * / ^ < > = & |; others are functions: not, ne, le, ge",
                )
                .note(invalid),
            ExprErrorKind::InvalidValue { .. } => found("expr/invalid-value")
                .help("write a number, a name or a parenthesis")
                .note(invalid),
            ExprErrorKind::InvalidNumber { .. } => found("expr/invalid-number")
                .help("write a number such as 1.5 or 1e-3, not above 1e308")
                .note(invalid),
            ExprErrorKind::InvalidOperator { .. } => {
                found("expr/invalid-operator").help("the operators are + - * / ^ < > = & |")
            }
            ExprErrorKind::Parentheses { opening: true } => found("expr/unclosed")
                .help("write the closing parenthesis; without quotes a blank ends the expression"),
            ExprErrorKind::Parentheses { opening: false } => {
                found("expr/unopened").help("remove it, or write the opening parenthesis")
            }
            ExprErrorKind::Refused { deviation } => {
                let (nist, instead) = explain(*deviation);
                found("expr/quirk").help(instead).note(nist)
            }
            ExprErrorKind::Unit { help } => found("expr/unit").help(help.clone()),
            ExprErrorKind::TooLong => {
                found("expr/too-long").help("split it into several variables")
            }
        }
    }
}

/// The evaluation of an expression failed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{kind}")]
pub struct EvalError {
    /// Location in the expression's text.
    pub span: Span,
    /// The kind of error.
    pub kind: EvalErrorKind,
}

/// Error of an evaluation.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EvalErrorKind {
    /// No variable has this name.
    #[error("invalid function or value: no variable is called `{name}`")]
    UnknownName {
        /// The name.
        name: String,
    },
    /// No function has this name and this number of arguments.
    #[error("invalid function or value: no function `{name}` takes {arguments} argument(s)")]
    UnknownFunction {
        /// The name.
        name: String,
        /// The number of arguments.
        arguments: usize,
    },
    /// `@file` takes x and, if wanted, a column.
    #[error("file function {file} requires 1 or 2 arguments, not {arguments}")]
    FileArguments {
        /// The file.
        file: String,
        /// The number of arguments.
        arguments: usize,
    },
    /// The look-up in a file failed.
    #[error("{error}")]
    Table {
        /// The file.
        file: String,
        /// The kind of error.
        error: TableError,
    },
    /// A vector of several elements where the sound dialect wants a number.
    #[error("{}", refusal(*deviation))]
    Vector {
        /// The deviation of NIST's program.
        deviation: TextDeviation,
    },
}

impl EvalError {
    /// The error for people; `known` are the variables that a wrong name is compared with.
    /// The span is that of the expression's text.
    pub fn diagnostic<'a>(&self, known: impl IntoIterator<Item = &'a str>) -> Diagnostic {
        let found = |code| Diagnostic::error(code, self.span, self.to_string());
        let functions = || Function::ALL.iter().map(|function| function.name());
        match &self.kind {
            EvalErrorKind::UnknownName { name } if name.starts_with('$') => {
                found("expr/unknown-name")
                    .help("a `$` parameter is a text; expressions can read `#` parameters only")
            }
            EvalErrorKind::UnknownName { name } => {
                found("expr/unknown-name").help_if(did_you_mean(name, known).or_else(|| {
                    match Function::find(name) {
                        Some(function) => Some(usage(function)),
                        None => Some("define it in VARIABLES, before it is used".into()),
                    }
                }))
            }
            EvalErrorKind::UnknownFunction { name, .. } => found("expr/unknown-function").help_if(
                Function::find(name)
                    .map(usage)
                    .or_else(|| did_you_mean(name, functions()))
                    .or_else(|| Some("docs/language.md lists the functions".into())),
            ),
            EvalErrorKind::FileArguments { file, .. } => {
                found("expr/file-arguments").help(format!("write @{file}(x), or @{file}(x,column)"))
            }
            EvalErrorKind::Table { .. } => found("expr/table").help(
                "files are looked for in the working folder, beside the program and along \
                 SCATMECH; lines of numbers are a table",
            ),
            EvalErrorKind::Vector { deviation } => {
                let (nist, instead) = explain(*deviation);
                found("expr/quirk").help(instead).note(nist)
            }
        }
    }
}

fn usage(function: Function) -> String {
    let arguments = match (function, function.arity()) {
        (Function::If, _) => "c,a,b",
        (Function::Atan2 | Function::Atan2d, _) => "y,x",
        (_, 1) => "x",
        _ => "a,b",
    };
    format!("write {}({arguments}): {}", function.name(), function.summary())
}
