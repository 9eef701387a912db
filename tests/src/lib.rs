//! Support for the tests of the whole workspace: conformance programs ([`corpus`], [`compare`]),
//! programs with inline expectations ([`suite`]) and the scanner of the architecture test
//! ([`sources`]).

pub mod compare;
pub mod corpus;
pub mod sources;
pub mod suite;
