//! What the fuzz targets assert, and the texts that they make of bytes.
//!
//! The laws themselves are those of the property tests: one text that breaks one of them becomes
//! a test there.

pub mod check;
pub mod likely;
pub mod spectrum;

#[path = "../../mist-format/tests/laws/mod.rs"]
pub mod laws;
#[path = "../../rise-bridge/tests/laws/mod.rs"]
pub mod tables;
