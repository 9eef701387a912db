//! A MIST program as a tree: sections in order, every text with its location.
//!
//! [`parse()`] reads a program, [`Program`]'s `Display` prints it with its comments.

mod check;
mod colour;
mod compare;
mod files;
mod integral;
mod lex;
mod limits;
mod parse;
mod print;
mod text;
mod tree;

pub use check::REQUIRED_VARIABLES;
pub use colour::{ColourEntry, ColourKey, ColourStatements};
pub use files::{BasisName, FilesEntry, FilesKey, FilesSection};
pub use integral::{ApertureShape, Integral, IntegralParameter};
pub use lex::count_tokens;
pub use limits::MAX_PROGRAM_BYTES;
pub use parse::parse;
pub use text::SourceText;
pub use tree::{
    Comment, ForLoop, ListLoop, Loop, Output, Program, ProgramVariable, Sections, VariableKind,
};
