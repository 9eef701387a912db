#![doc = include_str!("../README.md")]

pub mod diagnostic;
pub mod dialect;
pub mod expr;
pub mod number;
pub mod optics;
pub mod program;
pub mod span;
pub mod suggestion;
pub mod table;

pub use diagnostic::{Diagnostic, Note, Severity};
pub use dialect::{Dialect, Quirk};
pub use program::Program;
pub use span::{LineIndex, Place, Span};
