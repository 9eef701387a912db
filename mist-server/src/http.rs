//! The service over HTTP: the only modules that know statuses, headers and axum.

mod admission;
mod client;
mod color;
mod error;
mod evaluate;
mod export;
mod extract;
mod failed_keys;
mod file_response;
mod guard;
mod health;
mod integrate;
mod job_document;
mod jobs;
mod listen;
mod materials;
mod media;
mod metrics;
mod models;
mod origin;
mod page;
mod preconditions;
mod prepared_lobes;
mod problem;
mod program;
mod query;
mod renderer;
mod routes;
mod run;
mod schema;
mod state;
mod table;
mod warnings;

pub use listen::serve;
pub use routes::{openapi, router};
pub use state::{App, StartError};
