//! Runs whole programs and compares their tables with what NIST's MIST wrote for them; reads the
//! sources of the workspace for the architecture test.
//!
//! `conformance/programs/manifest.json` says how closely; see `conformance/README.md`.

pub mod compare;
pub mod corpus;
pub mod sources;
pub mod suite;
