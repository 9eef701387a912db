//! Shards: parts of a run on disk, each a journal JOB.k-of-n that a later process continues.
//!
//! A journal has one JSON value per line: the label of the shard, one line per finished step, and a
//! last line when all steps are finished. Lines are only appended, so a process that dies leaves
//! whole lines and at most one torn line, which the next process cuts off.

use std::{
    fmt,
    fs::{File, OpenOptions},
    io::{self, BufRead, BufReader, BufWriter, Seek, SeekFrom, Write},
    ops::Range,
    path::{Path, PathBuf},
    str::FromStr,
};

use mist_engine::{Job, OutputStream, Sink};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// Version of the format of journals.
const FORMAT: &str = "mist-shard-1";

/// One of the equal parts into which the steps of a run are split.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    /// From 1.
    pub number: u64,
    /// Number of parts.
    pub of: u64,
}

impl Shard {
    /// Its steps of a job of `steps` steps. They are neighbours, so that they share computations.
    pub fn steps(self, steps: u64) -> Range<u64> {
        let end = |k: u64| (u128::from(steps) * u128::from(k) / u128::from(self.of)) as u64;
        end(self.number - 1)..end(self.number)
    }

    /// Name of its journal.
    pub fn file_name(self, job: &str) -> String {
        format!("{job}.{}-of-{}", self.number, self.of)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers =
            text.split_once('/').and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((number, of)) if 1 <= number && number <= of => Ok(Self { number, of }),
            _ => Err("expected k/n with k from 1 to n, such as 3/16".into()),
        }
    }
}

/// A text of the run: its file, and the lines before the first step.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TextHead {
    /// Name of the file.
    pub name: String,
    /// The lines before the first step.
    pub head: String,
}

/// The first line of a journal: the run and the shard that it belongs to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ShardLabel {
    format: String,
    /// Of program, mode, seed, name of the job and version.
    digest: String,
    /// Name of the job.
    pub job: String,
    /// The shard.
    pub shard: Shard,
    /// Steps of the whole job.
    pub steps: u64,
    /// The table of results.
    pub results: TextHead,
    /// The listing.
    pub listing: TextHead,
    /// The samples, if the program has any.
    pub samples: Option<TextHead>,
}

impl ShardLabel {
    /// The label of a shard of `job`; `options` is everything else that its numbers depend on.
    pub fn new(job: &Job, name: &str, shard: Shard, steps: u64, options: &str) -> Self {
        let mut digest = Sha256::new();
        for part in [env!("CARGO_PKG_VERSION"), name, options] {
            digest.update(part.as_bytes());
            digest.update([0]);
        }
        let digest = digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        let head = |name: String, stream| TextHead { name, head: job.head(stream) };
        Self {
            format: FORMAT.into(),
            digest,
            job: name.into(),
            shard,
            steps,
            results: head(job.results_name(), OutputStream::Results),
            listing: head(job.listing_name(), OutputStream::Listing),
            samples: job.samples_name().map(|name| head(name, OutputStream::Samples)),
        }
    }

    /// True if both belong to the same run.
    pub fn is_same_run(&self, other: &Self) -> bool {
        let shard = Shard { number: 1, of: self.shard.of };
        Self { shard, ..self.clone() }
            == Self { shard: Shard { number: 1, ..other.shard }, ..other.clone() }
    }
}

/// A line of a journal after the first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum JournalLine {
    /// The texts of a finished step.
    Step {
        /// Its number in the whole job.
        step: u64,
        /// Its rows of results.
        results: String,
        /// Its part of the listing.
        listing: String,
        /// Its samples.
        #[serde(default, skip_serializing_if = "String::is_empty")]
        samples: String,
    },
    /// All steps are finished.
    End {
        /// Time that the last process took.
        seconds: f64,
    },
}

/// Reads a journal line by line, as far as its lines are whole and in order.
pub struct JournalReader {
    lines: BufReader<File>,
    /// Bytes of the whole lines so far.
    whole: u64,
    /// The first line.
    pub label: ShardLabel,
    /// The next step.
    next: u64,
    ended: bool,
}

impl JournalReader {
    /// Opens the journal in `file`; `None` if its first line is not whole.
    ///
    /// # Errors
    ///
    /// If it cannot be read or is something else.
    pub fn new(file: File) -> io::Result<Option<Self>> {
        let mut lines = BufReader::new(file);
        let mut first = Vec::new();
        lines.read_until(b'\n', &mut first)?;
        if first.last() != Some(&b'\n') {
            let begins = format!("{{\"format\":\"{FORMAT}\"");
            let is_torn = first.len() < begins.len() && begins.as_bytes().starts_with(&first)
                || first.starts_with(begins.as_bytes());
            return if is_torn { Ok(None) } else { Err(no_journal()) };
        }
        let label: ShardLabel = serde_json::from_slice(&first).map_err(|_| no_journal())?;
        if label.format != FORMAT {
            return Err(no_journal());
        }
        let next = label.shard.steps(label.steps).start;
        Ok(Some(Self { lines, whole: first.len() as u64, label, next, ended: false }))
    }

    /// The next whole line.
    ///
    /// # Errors
    ///
    /// If it cannot be read.
    pub fn next_line(&mut self) -> io::Result<Option<JournalLine>> {
        let mut bytes = Vec::new();
        self.lines.read_until(b'\n', &mut bytes)?;
        if self.ended || bytes.last() != Some(&b'\n') {
            return Ok(None);
        }
        let Ok(line) = serde_json::from_slice(&bytes) else { return Ok(None) };
        let steps = self.label.shard.steps(self.label.steps);
        match &line {
            JournalLine::Step { step, .. } if *step == self.next && *step < steps.end => {
                self.next += 1
            }
            JournalLine::End { .. } if self.next == steps.end => self.ended = true,
            _ => return Ok(None),
        }
        self.whole += bytes.len() as u64;
        Ok(Some(line))
    }

    /// Number of finished steps.
    pub fn finished(&self) -> u64 {
        self.next - self.label.shard.steps(self.label.steps).start
    }

    /// True if the last line was read.
    pub fn is_complete(&self) -> bool {
        self.ended
    }
}

fn no_journal() -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, "it is not a shard of a run of this version")
}

/// Error of [`JournalWriter::open`].
#[derive(Debug, thiserror::Error)]
pub enum JournalError {
    /// The file cannot be read or written.
    #[error("{path}: {source}", path = .path.display())]
    Disk {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// Another process writes the file.
    #[error("{path} is being written by another process", path = .0.display())]
    Busy(PathBuf),
    /// The file has steps of another run.
    #[error(
        "{path} belongs to a run of another program, mode, seed or version: remove it, or give another --job or --out",
        path = .0.display()
    )]
    Foreign(PathBuf),
}

/// Appends finished steps to a journal.
pub struct JournalWriter {
    file: BufWriter<File>,
    /// The first step that is not finished.
    pub next: u64,
    /// True if the journal was complete when it was opened.
    pub complete: bool,
    texts: [String; 3],
}

impl JournalWriter {
    /// Begins the journal `path`, or continues it after its last finished step.
    ///
    /// # Errors
    ///
    /// If it cannot be read or written, another process writes it, or it belongs to another run.
    pub fn open(path: &Path, label: &ShardLabel) -> Result<Self, JournalError> {
        let disk = |source| JournalError::Disk { path: path.to_owned(), source };
        let open =
            OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path);
        let mut file = open.map_err(disk)?;
        file.try_lock().map_err(|_| JournalError::Busy(path.to_owned()))?;
        let reader = file.try_clone().and_then(JournalReader::new).map_err(disk)?;
        let mut next = label.shard.steps(label.steps).start;
        let (mut whole, mut complete) = (0, false);
        if let Some(mut reader) = reader {
            if reader.label != *label {
                return Err(JournalError::Foreign(path.to_owned()));
            }
            while reader.next_line().map_err(disk)?.is_some() {}
            (next, whole, complete) = (reader.next, reader.whole, reader.ended);
        }
        file.set_len(whole).and_then(|()| file.seek(SeekFrom::End(0))).map_err(disk)?;
        let mut journal =
            Self { file: BufWriter::new(file), next, complete, texts: Default::default() };
        if whole == 0 {
            journal.add(label).and_then(|()| journal.file.flush()).map_err(disk)?;
        }
        Ok(journal)
    }

    /// Writes the last line: all steps are finished.
    ///
    /// # Errors
    ///
    /// If that cannot be written.
    pub fn end(mut self, seconds: f64) -> io::Result<()> {
        self.add(&JournalLine::End { seconds })?;
        self.file.flush()?;
        self.file.get_ref().sync_all()
    }

    fn add(&mut self, line: &impl Serialize) -> io::Result<()> {
        let mut text = serde_json::to_vec(line)?;
        text.push(b'\n');
        self.file.write_all(&text)
    }
}

impl Sink for JournalWriter {
    fn write(&mut self, stream: OutputStream, text: &str) -> io::Result<()> {
        self.texts[stream as usize].push_str(text);
        Ok(())
    }

    fn step_done(&mut self, step: u64) -> io::Result<()> {
        let take = |text: &mut String| std::mem::take(text);
        let [results, listing, samples] = self.texts.each_mut().map(take);
        self.add(&JournalLine::Step { step, results, listing, samples })?;
        self.next = step + 1;
        Ok(())
    }

    fn block_done(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_cover_all_steps_once() {
        for (steps, of) in [(0, 3), (2, 5), (100, 7), (u64::MAX, 3)] {
            let mut next = 0;
            for number in 1..=of {
                let part = Shard { number, of }.steps(steps);
                assert_eq!(part.start, next);
                next = part.end;
            }
            assert_eq!(next, steps);
        }
    }

    #[test]
    fn shards_are_written_as_a_fraction() {
        assert_eq!("3/16".parse(), Ok(Shard { number: 3, of: 16 }));
        for wrong in ["0/4", "5/4", "3", "a/b", "1/0", "-1/2"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
