//! Runs of compiled jobs into files: whole ones, and shards that a later process continues.

use std::{
    io::{self, Write},
    path::{Path, PathBuf},
};

use mist_engine::{Control, Failure, Job, Options, OutputStream, RunSummary, Sink, TableLine};
use rise_bridge::write::Style;

use crate::{
    colours::{self, SaveError},
    files::{AtomicFile, WrittenFile},
    shard::{JournalError, JournalWriter, Shard, ShardLabel},
    targets,
};

/// Takes the lines of the results.
pub type LineWatch<'w> = &'w mut (dyn FnMut(&TableLine) + Send);

/// Reason why a compiled job has no results on disk.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The job failed.
    #[error(transparent)]
    Engine(#[from] Failure),
    /// A file cannot be written.
    #[error("cannot write {path}: {source}", path = .path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// A colour table cannot be written.
    #[error(transparent)]
    Colours(#[from] SaveError),
    /// The program cannot be split into shards.
    #[error(
        "this program cannot be split: its variables, loops or apertures read integrals or \
         outputs of earlier steps, so its steps must run one after the other; run it without \
         --shard"
    )]
    Sequential,
    /// The journal of a shard cannot be opened.
    #[error(transparent)]
    Journal(#[from] JournalError),
    /// The journal of a shard cannot be finished.
    #[error("{0}")]
    JournalEnd(io::Error),
    /// A shard was cancelled; its finished steps are kept.
    #[error("the run was cancelled; the same command goes on behind its last finished step")]
    ShardCancelled,
}

impl RunError {
    /// True if the request is at fault, and not the computation or a disk.
    pub fn is_refusal(&self) -> bool {
        matches!(
            self,
            Self::Engine(Failure::Program(_))
                | Self::Sequential
                | Self::Journal(JournalError::Foreign(_))
        )
    }
}

/// Runs `job` and writes its files below the folder `out`.
///
/// # Errors
///
/// If the job fails or a file cannot be written.
pub fn run_to_files(
    job: &Job,
    out: &Path,
    control: &Control,
) -> Result<(RunSummary, Vec<WrittenFile>), RunError> {
    run_and_watch(job, out, control, &mut |_| ())
}

/// [`run_to_files`]; `watch` sees the lines of the results.
///
/// # Errors
///
/// The same.
pub fn run_and_watch(
    job: &Job,
    out: &Path,
    control: &Control,
    watch: LineWatch<'_>,
) -> Result<(RunSummary, Vec<WrittenFile>), RunError> {
    let mut sink = FileSink::create(job, out, watch)?;
    let summary = job.run(&mut sink, control)?;
    let mut files = sink.finish()?;
    if let Some(table) = &summary.colour {
        for (format, name) in targets::colour_files(job) {
            files.extend(colours::save(format, table, &out.join(name), Style::default())?);
        }
    }
    Ok((summary, files))
}

/// A shard after its run.
#[derive(Debug)]
pub struct ShardRun {
    /// The work of this process; nothing if the shard was complete.
    pub summary: RunSummary,
    /// The journal.
    pub path: PathBuf,
    /// Steps of the shard.
    pub steps: u64,
    /// Steps of the shard that an earlier process finished.
    pub steps_before: u64,
    /// Steps of the whole job.
    pub job_steps: u64,
}

/// Runs the unfinished steps of `shard` of the job that `program` was compiled to with `options`,
/// into a journal in the folder `out`.
///
/// # Errors
///
/// If the program cannot be split, the journal belongs to another run or process, a step fails, or
/// the journal cannot be written.
pub fn run_shard(
    job: &Job,
    (options, program): (&Options, &str),
    shard: Shard,
    out: &Path,
    control: &Control,
) -> Result<ShardRun, RunError> {
    if job.runs_in_order() {
        return Err(RunError::Sequential);
    }
    let name = &options.job;
    let job_steps = job.count_steps(control)?;
    let inputs = format!("{:?} {} {program}", options.mode, options.seed);
    let label = ShardLabel::new(job, name, shard, job_steps, &inputs);
    let path = out.join(shard.file_name(name));
    let mut journal = JournalWriter::open(&path, &label)?;
    let part = shard.steps(job_steps);
    let steps_before = journal.next - part.start;
    let mut summary = RunSummary::default();
    if !journal.complete {
        summary =
            job.run_part(journal.next..part.end, &mut journal, control).map_err(|failure| {
                match failure {
                    Failure::Cancelled => RunError::ShardCancelled,
                    other => RunError::Engine(other),
                }
            })?;
        journal.end(summary.seconds).map_err(RunError::JournalEnd)?;
    }
    Ok(ShardRun { summary, path, steps: part.end - part.start, steps_before, job_steps })
}

/// Writes results, listing and samples of one job; the files have their names only when all are
/// whole.
struct FileSink<'w> {
    watch: LineWatch<'w>,
    results: AtomicFile,
    listing: AtomicFile,
    samples: Option<AtomicFile>,
}

impl<'w> FileSink<'w> {
    /// Begins the files that `job` writes, below `out`.
    fn create(job: &Job, out: &Path, watch: LineWatch<'w>) -> Result<Self, RunError> {
        let create = |name: &str| {
            let path = out.join(name);
            AtomicFile::create(&path).map_err(|source| RunError::Write { path, source })
        };
        Ok(Self {
            watch,
            results: create(&job.results_name())?,
            listing: create(&job.listing_name())?,
            samples: job.samples_name().as_deref().map(create).transpose()?,
        })
    }

    /// Gives the files their names.
    fn finish(self) -> Result<Vec<WrittenFile>, RunError> {
        let titled = [
            Some(("results", self.results)),
            Some(("listing", self.listing)),
            self.samples.map(|samples| ("samples", samples)),
        ];
        let finish = |(title, file): (_, AtomicFile)| {
            let path = file.path().to_owned();
            match file.finish() {
                Ok(replaces) => Ok(WrittenFile { title, path, replaces }),
                Err(source) => Err(RunError::Write { path, source }),
            }
        };
        titled.into_iter().flatten().map(finish).collect()
    }
}

impl Sink for FileSink<'_> {
    fn row(&mut self, line: &TableLine) -> io::Result<()> {
        (self.watch)(line);
        Ok(())
    }

    fn write(&mut self, stream: OutputStream, text: &str) -> io::Result<()> {
        let file = match stream {
            OutputStream::Results => &mut self.results,
            OutputStream::Listing => &mut self.listing,
            OutputStream::Samples => match &mut self.samples {
                Some(samples) => samples,
                None => return Ok(()),
            },
        };
        file.write_all(text.as_bytes())
    }
}
