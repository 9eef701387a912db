//! The HTTP service behind `mist serve`.
//!
//! It computes tables and evaluations of materials for renderers, and runs programs as jobs. What
//! it keeps outlives it in one file. It knows no arguments and no terminal.

mod access;
mod compute;
mod failure;
mod jobs;
mod limits;
mod materials;
mod memory;
mod metrics;
mod output;
mod program;
mod service;
mod single_flight;
mod store;

pub mod http;
pub mod keys;

pub use access::AccessOptions;
pub use limits::ServeLimits;
pub use service::{ServeError, ServeOptions, serve};
