//! The texts of optical constants, tables and film stacks, as parameters of a model hold them.
//!
//! Here a text becomes a typed description; files are opened by someone else.

mod index;
mod stack;
mod table_text;

pub use index::IndexText;
pub use stack::{Film, StackText};
pub use table_text::TableText;

use crate::dialect::Quirk;
use crate::expr::ExprError;

/// Why a text is no optical constant, table or stack.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OpticsError {
    /// There is no text.
    #[error("the text is empty")]
    Empty,
    /// A parenthesis that holds no n and k.
    #[error("`{text}` is no (n,k)")]
    Pair {
        /// The text.
        text: String,
    },
    /// A formula `@v:…` that is no expression.
    #[error("the formula `{text}` is no expression: {error}")]
    Formula {
        /// The expression.
        text: String,
        /// Why.
        error: ExprError,
    },
    /// A thickness that is no number, or a material without one.
    #[error("{}", thickness_problem(text))]
    Thickness {
        /// What stands there; empty if nothing does.
        text: String,
    },
    /// A comment in the last line, which has no line end: NIST's program never ends.
    #[error("line {line}: a comment in the last line, which has no line end")]
    OpenComment {
        /// The line, from 1.
        line: usize,
    },
    /// NIST's program reads something else than what is written.
    #[error("`{text}` is read by NIST's program as `{reading}`")]
    Refused {
        /// The text.
        text: String,
        /// What NIST's program makes of it.
        reading: String,
        /// Why.
        quirk: Quirk,
    },
}

fn thickness_problem(text: &str) -> String {
    match text {
        "" => "the last material has no thickness".into(),
        text => format!("the thickness `{text}` is no number, or negative"),
    }
}

impl OpticsError {
    /// What to write instead.
    pub fn help(&self) -> &'static str {
        match self {
            Self::Pair { .. } => "write (n,k) with two numbers and no blanks, such as (1.5,0.01)",
            Self::Empty => "write a number, (n,k), the name of a file, or a formula @x:n,k",
            Self::Formula { .. } => "write @x:n,k with expressions of x, the wavelength in µm",
            Self::Thickness { .. } => {
                "write pairs of a material and a thickness in µm; no blanks inside (n,k)"
            }
            Self::OpenComment { .. } => "end the last line",
            Self::Refused { quirk: Quirk::NegativeThickness, .. } => {
                "a thickness is zero or more, in µm"
            }
            Self::Refused { .. } => {
                "write a plain number, (n,k), or a file name that begins with a letter; \
                 put arithmetic into a `#` parameter"
            }
        }
    }
}
