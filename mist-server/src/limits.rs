//! Bounds for the clients of the service; each is a flag of `mist serve`.

use std::time::Duration;

/// The bounds for clients. An answer that refuses names the flag and its value.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Limits")]
pub struct ServeLimits {
    /// Bytes of the body of a request.
    #[arg(long, default_value_t = 16 << 20, value_name = "BYTES")]
    pub max_body: usize,
    /// Bytes of the text of a program, its data files excepted.
    #[arg(long, default_value_t = 1 << 20, value_name = "BYTES")]
    pub max_program: usize,
    /// Tokens of a program: words, numbers and signs.
    #[arg(long, default_value_t = 200_000, value_name = "N")]
    pub max_tokens: usize,
    /// Evaluations of the model for one answer or job.
    #[arg(long, default_value_t = 1e11, value_name = "N")]
    pub max_evaluations: f64,
    /// Directions held in memory: of one integral, or of all patches of a table.
    #[arg(long, default_value_t = 4e6, value_name = "N")]
    pub max_directions: f64,
    /// Steps of the loops of a program, and nodes of a grid.
    #[arg(long, default_value_t = 4_000_000, value_name = "N")]
    pub max_steps: u64,
    /// Numbers of a table: rows times wavelengths times Stokes components.
    #[arg(long, default_value_t = 3e7, value_name = "N")]
    pub max_numbers: f64,
    /// Wavelengths of one answer: a model is built for each.
    #[arg(long, default_value_t = 2000, value_name = "N")]
    pub max_wavelengths: usize,
    /// Bytes of results, listing and samples of a run together.
    #[arg(long, default_value_t = 256 << 20, value_name = "BYTES")]
    pub max_output: usize,
    /// Approximate bytes that bodies and tables in the making hold together.
    #[arg(long, default_value_t = 4 << 30, value_name = "BYTES")]
    pub max_memory: usize,
    /// Seconds that one answer may be computed.
    #[arg(long, default_value_t = 300.0, value_name = "SECONDS")]
    pub max_time: f64,
    /// Seconds that one answer may be computed for a key with the scope `read`.
    #[arg(long, default_value_t = 10.0, value_name = "SECONDS")]
    pub max_read_time: f64,
    /// Evaluations of the model for one answer to a key with the scope `read`.
    #[arg(long, default_value_t = 1e7, value_name = "N")]
    pub max_read_evaluations: f64,
    /// Seconds that a job may run.
    #[arg(long, default_value_t = 86_400.0, value_name = "SECONDS")]
    pub max_job_time: f64,
    /// Answers that are computed at the same time, and as many small ones; each has threads of
    /// its own.
    #[arg(long, default_value_t = 16, value_name = "N")]
    pub max_computing: usize,
    /// Answers for one client that are computed at the same time, and as many small ones.
    #[arg(long, default_value_t = 2, value_name = "N")]
    pub max_client_computing: usize,
    /// Answers that wait for that.
    #[arg(long, default_value_t = 1024, value_name = "N")]
    pub max_waiting: usize,
    /// Answers for one client that wait for that, and as many small ones.
    #[arg(long, default_value_t = 128, value_name = "N")]
    pub max_client_waiting: usize,
    /// Jobs that run at the same time; each uses all threads.
    #[arg(long, default_value_t = 1, value_name = "N")]
    pub max_running: usize,
    /// Jobs that wait, of all clients.
    #[arg(long, default_value_t = 1000, value_name = "N")]
    pub max_queued: usize,
    /// Jobs of one client that wait or run.
    #[arg(long, default_value_t = 200, value_name = "N")]
    pub max_client_jobs: usize,
    /// Bytes of the programs and results of all jobs; the oldest finished jobs are forgotten.
    #[arg(long, default_value_t = 4 << 30, value_name = "BYTES")]
    pub max_stored: u64,
    /// Finished jobs that are kept; older ones are forgotten.
    #[arg(long, default_value_t = 1000, value_name = "N")]
    pub max_finished: usize,
    /// Materials that are kept.
    #[arg(long, default_value_t = 10_000, value_name = "N")]
    pub max_materials: usize,
    /// Bytes of tables that are kept for later requests.
    #[arg(long, default_value_t = 256 << 20, value_name = "BYTES")]
    pub max_kept: usize,
    /// Open connections.
    #[arg(long, default_value_t = 1024, value_name = "N")]
    pub max_connections: usize,
    /// Open connections of one address; not for those that a proxy forwards.
    #[arg(long, default_value_t = 128, value_name = "N")]
    pub max_client_connections: usize,
    /// Seconds in which the head of a request must be sent, then its body, and in which something
    /// of the answer must be read.
    #[arg(long, default_value_t = 60.0, value_name = "SECONDS")]
    pub max_silence: f64,
}

impl Default for ServeLimits {
    /// The bounds of `mist serve` without flags.
    fn default() -> Self {
        #[derive(clap::Parser)]
        struct Flags {
            #[command(flatten)]
            limits: ServeLimits,
        }
        <Flags as clap::Parser>::parse_from(["mist"]).limits
    }
}

impl ServeLimits {
    /// The bounds of a table or a run that ends within `seconds`.
    pub(crate) fn engine(&self, seconds: f64) -> mist_engine::Limits {
        mist_engine::Limits {
            evaluations: self.max_evaluations,
            directions: self.max_directions,
            steps: self.max_steps,
            time: Some(duration(seconds)),
        }
    }

    /// The bounds of a client that may only look.
    pub(crate) fn of_reader(&self) -> Self {
        Self {
            max_evaluations: self.max_evaluations.min(self.max_read_evaluations),
            max_time: self.max_time.min(self.max_read_time),
            ..self.clone()
        }
    }

    /// Longest time for which one answer may be computed.
    pub(crate) fn time(&self) -> Duration {
        duration(self.max_time)
    }

    /// Longest time in which a client may send a head or a body.
    pub(crate) fn silence(&self) -> Duration {
        duration(self.max_silence)
    }
}

/// A limit of the service that was reached.
#[derive(Clone, Debug)]
pub(crate) struct LimitReached {
    /// The flag of `mist serve`, without dashes.
    pub(crate) flag: &'static str,
    /// Its value.
    pub(crate) value: f64,
    /// The message for people.
    pub(crate) message: String,
}

/// A length of time; one that no clock can count is a century.
fn duration(seconds: f64) -> Duration {
    const CENTURY: Duration = Duration::from_secs(100 * 365 * 86_400);
    Duration::try_from_secs_f64(seconds).unwrap_or(CENTURY).min(CENTURY)
}
