//! Programs that run in the background and outlive the service.
//!
//! A job is stored from the moment it is accepted; its finished steps are stored while it runs, its
//! texts when it is over. A service that starts continues the jobs that were not over, in the
//! order in which they came.

mod error;
mod handle;
mod job;
mod queue;
mod scheduler;
mod status;
mod step_journal;
mod worker;

pub(crate) use error::JobsError;
pub(crate) use handle::Jobs;
pub(crate) use job::ServiceJob;
pub(crate) use status::{JobState, JobStatus};
