//! Compiles MIST programs to jobs and runs them.
//!
//! [`compile()`] turns the text of a program and its data files into an immutable [`Job`];
//! [`Job::run`] replays its expressions step by step, evaluates the model in parallel and
//! writes the tables through a [`Sink`]. Between the two everything is a pure function of the
//! job: the same numbers to the last bit on any number of threads.
//!
//! ```
//! use std::sync::Arc;
//!
//! use mist_engine::{Control, MemoryFiles, MemorySink, Options, compile};
//!
//! let program = "
//!     MODEL = Lambertian_BRDF_Model
//!     VARIABLES:
//!       incidentangle = 0.5   incidentpol = (1,0,0,0)   rotation = 0
//!       differential = 0.01   minsamples = 100
//!     END
//!     VARY: END
//!     INTEGRALS: R = HEMI END END
//!     OUTPUTS: 1 R END
//!     FILES: END
//! ";
//! let job = compile(program, Arc::new(MemoryFiles::default()), &Options::default()).unwrap();
//! let mut sink = MemorySink::default();
//! job.run(&mut sink, &Control::default()).unwrap();
//! assert_eq!(sink.results, "R\n         1\n");
//! ```
//!
//! The crate opens no file and no socket, and starts no thread pool.

mod advice;
mod evaluate;
mod fault;
mod files;
mod graph;
mod journal;
mod limits;
mod listing;
mod plan;
mod slots;
mod step;
mod sum;
mod sweep;
mod uncertainty;
mod values;
mod warning;

pub mod colour;
pub mod compile;
pub mod deviation;
pub mod fit;
pub mod function;
pub mod integrate;
pub mod job;
pub mod material;
pub mod output;
pub mod parameters;
pub mod region;
pub mod replay;
pub mod request;
pub mod run;
pub mod sampling;
pub mod tolerance;

pub use compile::compile;
pub use fault::{Failure, Fault};
pub use files::{DataFiles, FileError, Files, MemoryFiles};
pub use job::{Job, Options};
pub use journal::{Journal, StepResult};
pub use limits::{Control, Limits};
pub use output::{MemorySink, OutputStream, Sink, TableLine};
pub use run::RunSummary;
pub use step::{Evaluated, Step};
pub use warning::Warning;
