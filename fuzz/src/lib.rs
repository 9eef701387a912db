//! Assertions of the fuzz targets, and the generation of texts from bytes.
//!
//! The properties are those of the property tests. A text that violates one is added to those tests.

pub mod check;
pub mod likely;
pub mod spectrum;

#[path = "../../mist-format/tests/laws/mod.rs"]
pub mod laws;
#[path = "../../rise-bridge/tests/laws/mod.rs"]
pub mod tables;
