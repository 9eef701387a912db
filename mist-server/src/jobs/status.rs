//! The state of a job and its times.

use std::time::{SystemTime, UNIX_EPOCH};

use serde::{Deserialize, Serialize};

use crate::failure::{FailureReport, LocatedDiagnostic};

/// State of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, utoipa::ToSchema)]
#[schema(as = State)]
#[serde(rename_all = "lowercase")]
pub(crate) enum JobState {
    /// It waits.
    Queued,
    /// It runs.
    Running,
    /// Its texts are there.
    Done,
    /// It ended without its texts.
    Failed,
    /// A client cancelled it.
    Cancelled,
}

impl JobState {
    /// Every state.
    pub(crate) const ALL: [Self; 5] =
        [Self::Queued, Self::Running, Self::Done, Self::Failed, Self::Cancelled];

    /// Its name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Queued => "queued",
            Self::Running => "running",
            Self::Done => "done",
            Self::Failed => "failed",
            Self::Cancelled => "cancelled",
        }
    }

    /// True if it will not change any more.
    pub(crate) fn is_over(self) -> bool {
        matches!(self, Self::Done | Self::Failed | Self::Cancelled)
    }
}

/// Status of a job; times are seconds since 1970.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(crate) struct JobStatus {
    /// Name in addresses.
    pub(crate) id: String,
    /// Its state.
    pub(crate) state: JobState,
    /// The part that is done, 0 to 1.
    pub(crate) progress: f64,
    /// The name that was given to it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) job: Option<String>,
    /// Time of its arrival.
    pub(crate) submitted: f64,
    /// Time of its last start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) started: Option<f64>,
    /// Time of its end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) finished: Option<f64>,
    /// Lines before the line of names in its results.
    #[serde(default)]
    pub(crate) header_lines: usize,
    /// Steps of its loops, once it is done.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) steps: Option<u64>,
    /// Steps that an earlier run of the service had finished already.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) resumed_after: Option<u64>,
    /// The reason why it failed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) problem: Option<FailureReport>,
    /// Defects of NIST's library that a sound run stepped around.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) defects: Vec<String>,
    /// Warnings of results that are probably not what was meant.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) warnings: Vec<LocatedDiagnostic>,
    /// The texts that can be had when it is done: `results`, `listing`, `samples`, `table.…`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) texts: Vec<String>,
}

impl JobStatus {
    /// A job that came now.
    pub(super) fn new(id: String, job: Option<String>) -> Self {
        Self {
            id,
            state: JobState::Queued,
            progress: 0.0,
            job,
            submitted: now(),
            started: None,
            finished: None,
            header_lines: 0,
            steps: None,
            resumed_after: None,
            problem: None,
            defects: Vec::new(),
            warnings: Vec::new(),
            texts: Vec::new(),
        }
    }

    pub(super) fn start(&mut self) {
        self.state = JobState::Running;
        self.started = Some(now());
    }

    pub(super) fn finish(&mut self, state: JobState) {
        self.state = state;
        self.finished = Some(now());
        if state == JobState::Done {
            self.progress = 1.0;
        }
    }

    /// Marks a job as failed because its texts cannot be stored.
    pub(super) fn lose_texts(&mut self, why: &str) {
        self.state = JobState::Failed;
        self.problem = Some(FailureReport::new("unavailable", why));
        self.texts.clear();
    }
}

/// Seconds since 1970, to a millisecond.
fn now() -> f64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    since.as_millis() as f64 / 1000.0
}
