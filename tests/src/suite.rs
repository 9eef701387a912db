//! Programs of `tests/suite`: each file is one test, with its expectations in comments.
//!
//! `tests/README.md` describes the comments. [`instructions`] reads them, [`judge`] runs a program
//! and compares.

pub mod instructions;
pub mod judge;
