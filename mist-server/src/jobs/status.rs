//! Where a job stands.

use std::time::{SystemTime, UNIX_EPOCH};

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::http::Problem;

/// What a job is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum State {
    /// It waits.
    Queued,
    /// It runs.
    Running,
    /// Its texts are there.
    Done,
    /// It ended without its texts.
    Failed,
    /// Somebody did not want it any more.
    Cancelled,
}

impl State {
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

    /// Whether nothing more will happen.
    pub(crate) fn is_over(self) -> bool {
        matches!(self, Self::Done | Self::Failed | Self::Cancelled)
    }
}

/// Where a job stands; times are seconds since 1970.
#[derive(Clone, Debug, Deserialize, Serialize, ToSchema)]
pub(crate) struct Status {
    /// Its name in addresses.
    pub(crate) id: String,
    /// What it is doing.
    pub(crate) state: State,
    /// The part that is done, 0 to 1.
    pub(crate) progress: f64,
    /// The name that was given to it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) job: Option<String>,
    /// When it came.
    pub(crate) submitted: f64,
    /// When it was begun last.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) started: Option<f64>,
    /// When it was over.
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
    /// Why it failed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) problem: Option<Problem>,
    /// Defects of NIST's library that a sound run stepped around.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) defects: Vec<String>,
    /// The texts that can be had when it is done: `results`, `listing`, `samples`, `table.…`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) texts: Vec<String>,
}

impl Status {
    /// A job that came now.
    pub(super) fn new(id: String, job: Option<String>) -> Self {
        Self {
            id,
            state: State::Queued,
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
            texts: Vec::new(),
        }
    }

    pub(super) fn start(&mut self) {
        self.state = State::Running;
        self.started = Some(now());
    }

    pub(super) fn finish(&mut self, state: State) {
        self.state = state;
        self.finished = Some(now());
        if state == State::Done {
            self.progress = 1.0;
        }
    }

    /// Its end could not be kept, so its texts cannot be had.
    pub(super) fn lost(&mut self, why: &str) {
        let status = axum::http::StatusCode::SERVICE_UNAVAILABLE;
        self.state = State::Failed;
        self.problem = Some(Problem::new(status, "unavailable", why));
        self.texts.clear();
    }
}

/// Seconds since 1970, to a millisecond.
fn now() -> f64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    since.as_millis() as f64 / 1000.0
}
