//! Runs whole programs and compares their tables with what NIST's MIST wrote for them.
//!
//! `conformance/programs/manifest.json` says how closely; see `conformance/README.md`.

pub mod compare;
pub mod corpus;
