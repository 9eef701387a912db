//! Media types of bodies.

/// JSON.
pub(super) const JSON: &str = "application/json";
/// The text of a program, or rows of patches.
pub(super) const MIST: &str = "application/x-mist";
/// The vectors of a renderer.
pub(super) const VECTORS: &str = "application/octet-stream";
