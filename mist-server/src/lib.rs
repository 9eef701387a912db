//! The command line `mist` and the HTTP service behind `mist serve`.
//!
//! This is the only crate that knows terminals, sockets and the file system, and the only one
//! that starts threads.

mod cli;
mod compute;
mod disk;
mod interrupt;
mod jobs;
mod keys;
mod limits;
mod memory;
mod products;
mod progress;
mod registry;
mod report;
mod results;
mod shard;
mod store;
mod wanted;

pub mod http;

pub use cli::main;
pub use limits::ServeLimits;
