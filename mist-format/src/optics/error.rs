//! Errors of optical texts.

use crate::dialect::TextDeviation;
use crate::expr::ExprError;

/// Errors of reading optical constants, tables and stacks.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OpticsError {
    /// The text is empty.
    #[error("the text is empty")]
    Empty,
    /// A parenthesis without n and k.
    #[error("`{text}` is not a pair (n,k)")]
    Pair {
        /// The text.
        text: String,
    },
    /// A formula `@v:…` that is not an expression.
    #[error("the formula `{text}` is not an expression: {error}")]
    Formula {
        /// The expression.
        text: String,
        /// The error.
        error: ExprError,
    },
    /// A thickness that is not a number, or a material without thickness.
    #[error("{}", thickness_problem(text))]
    Thickness {
        /// The text of the thickness; empty if it is missing.
        text: String,
    },
    /// A comment in the last line, which has no line end: NIST's program never ends.
    #[error("line {line}: a comment in the last line, which has no line end")]
    OpenComment {
        /// The line, from 1.
        line: usize,
    },
    /// A text that NIST's program misreads.
    #[error("`{text}` is read by NIST's program as `{reading}`")]
    Refused {
        /// The text.
        text: String,
        /// The reading of NIST's program.
        reading: String,
        /// The deviation.
        deviation: TextDeviation,
    },
}

fn thickness_problem(text: &str) -> String {
    match text {
        "" => "the last material has no thickness".into(),
        text => format!("the thickness `{text}` is negative or not a number"),
    }
}

impl OpticsError {
    /// The remedy.
    pub fn help(&self) -> &'static str {
        match self {
            Self::Pair { .. } => "write (n,k) with two numbers and no blanks, such as (1.5,0.01)",
            Self::Empty => "write a number, (n,k), the name of a file, or a formula @x:n,k",
            Self::Formula { .. } => "write @x:n,k with expressions of x, the wavelength in µm",
            Self::Thickness { .. } => {
                "write pairs of a material and a thickness in µm; no blanks inside (n,k)"
            }
            Self::OpenComment { .. } => "end the last line",
            Self::Refused { deviation: TextDeviation::NegativeThickness, .. } => {
                "a thickness is zero or more, in µm"
            }
            Self::Refused { .. } => {
                "write a plain number, (n,k), or a file name that begins with a letter; \
                 put arithmetic into a `#` parameter"
            }
        }
    }
}
