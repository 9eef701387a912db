//! Reads a program, section by section, in the way of NIST's program.
//!
//! An error after which the rest is unreadable ends the reading; other errors are collected.

mod entries;
mod integrals;
mod parser;
mod sections;

use self::parser::Parser;
use super::check::check;
use super::limits::{MAX_ERRORS, MAX_PROGRAM_BYTES};
use super::tree::Program;
use crate::diagnostic::Diagnostic;
use crate::dialect::Dialect;
use crate::span::Span;

/// Reads a program.
///
/// # Errors
/// All errors, in the order of the text: those that NIST's program refuses or never finishes
/// reading, in both dialects; its misreadings, in the sound dialect.
pub fn parse(text: &str, dialect: Dialect) -> Result<Program, Vec<Diagnostic>> {
    if text.len() > MAX_PROGRAM_BYTES {
        let message = format!("the program is longer than {MAX_PROGRAM_BYTES} bytes");
        let found = Diagnostic::error("program/too-long", Span::empty(0), message);
        return Err(vec![
            found.help("keep long tables in files, and read them with LIST or @file"),
        ]);
    }
    let mut parser = Parser::new(text, dialect);
    let program = parser.program();
    let mut found = parser.found;
    if let Ok(program) = program {
        found.extend(check(&program, dialect));
        if found.is_empty() {
            return Ok(Program { comments: parser.reader.into_comments(), ..program });
        }
    }
    found.sort_by_key(|diagnostic| diagnostic.span);
    found.truncate(MAX_ERRORS);
    Err(found)
}
