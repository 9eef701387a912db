//! Runs programs from files into files, for the command line, the service and bindings.
//!
//! The crate reads data files from disk, writes results that appear whole or not at all, splits a
//! run into shards and merges them, and writes colour tables in their formats. It knows no
//! arguments, terminal or socket.

pub mod colours;
pub mod files;
pub mod merge;
pub mod registry;
pub mod results;
pub mod run;
pub mod shard;
pub mod targets;
