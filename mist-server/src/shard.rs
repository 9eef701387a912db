//! A part of a run on disk: the journal JOB.k-of-n.
//!
//! One JSON value per line: what the part belongs to, one line per finished step, a last line when
//! all steps are finished. Lines are only added, so a process that dies leaves whole lines and at
//! most a torn one, which the next process cuts off.

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

/// Changes when journals are written in another way.
const FORMAT: &str = "mist-shard-1";

/// Which of how many parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Shard {
    /// From 1.
    pub(crate) number: u64,
    /// How many parts there are.
    pub(crate) of: u64,
}

impl Shard {
    /// Its steps of a job of `steps`: a run of neighbours, so that they share what they can.
    pub(crate) fn steps(self, steps: u64) -> Range<u64> {
        let end = |k: u64| (u128::from(steps) * u128::from(k) / u128::from(self.of)) as u64;
        end(self.number - 1)..end(self.number)
    }

    /// The name of its journal.
    pub(crate) fn file_name(self, job: &str) -> String {
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

/// A text of the run: its file and what stands before the first step.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Head {
    pub(crate) name: String,
    pub(crate) head: String,
}

/// What a journal belongs to: its first line.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Label {
    format: String,
    /// Of program, mode, seed, name of the job and version.
    digest: String,
    pub(crate) job: String,
    pub(crate) shard: Shard,
    /// Steps of the whole job.
    pub(crate) steps: u64,
    pub(crate) results: Head,
    pub(crate) listing: Head,
    pub(crate) samples: Option<Head>,
}

impl Label {
    /// The label of a part of `job`; `options` is all else that its numbers depend on.
    pub(crate) fn new(job: &Job, name: &str, shard: Shard, steps: u64, options: &str) -> Self {
        let mut digest = Sha256::new();
        for part in [env!("CARGO_PKG_VERSION"), name, options] {
            digest.update(part.as_bytes());
            digest.update([0]);
        }
        let digest = digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        let head = |name: String, stream| Head { name, head: job.head(stream) };
        Self {
            format: FORMAT.into(),
            digest,
            job: name.into(),
            shard,
            steps,
            results: head(job.results_name(), OutputStream::Results),
            listing: head(job.listing_name(), OutputStream::Listing),
            samples: job.samples_name().map(|name| head(name.into(), OutputStream::Samples)),
        }
    }

    /// Whether both are parts of one run.
    pub(crate) fn is_of_the_run_of(&self, other: &Self) -> bool {
        let shard = Shard { number: 1, of: self.shard.of };
        Self { shard, ..self.clone() }
            == Self { shard: Shard { number: 1, ..other.shard }, ..other.clone() }
    }
}

/// A line behind the first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Line {
    /// The texts of a finished step.
    Step {
        /// Its number in the whole job.
        step: u64,
        results: String,
        listing: String,
        #[serde(default, skip_serializing_if = "String::is_empty")]
        samples: String,
    },
    /// All steps are finished.
    End {
        /// What the last process took.
        seconds: f64,
    },
}

/// Reads a journal line by line, as far as its lines are whole and in order.
pub(crate) struct Reader {
    lines: BufReader<File>,
    /// Bytes of the whole lines so far.
    whole: u64,
    pub(crate) label: Label,
    /// The next step.
    next: u64,
    ended: bool,
}

impl Reader {
    /// Opens the journal in `file`; none if not even its first line is whole.
    ///
    /// # Errors
    ///
    /// If it cannot be read or is something else.
    pub(crate) fn new(file: File) -> io::Result<Option<Self>> {
        let mut lines = BufReader::new(file);
        let mut first = Vec::new();
        lines.read_until(b'\n', &mut first)?;
        if first.last() != Some(&b'\n') {
            let begins = format!("{{\"format\":\"{FORMAT}\"");
            let is_torn = first.len() < begins.len() && begins.as_bytes().starts_with(&first)
                || first.starts_with(begins.as_bytes());
            return if is_torn { Ok(None) } else { Err(no_journal()) };
        }
        let label: Label = serde_json::from_slice(&first).map_err(|_| no_journal())?;
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
    pub(crate) fn next_line(&mut self) -> io::Result<Option<Line>> {
        let mut bytes = Vec::new();
        self.lines.read_until(b'\n', &mut bytes)?;
        if self.ended || bytes.last() != Some(&b'\n') {
            return Ok(None);
        }
        let Ok(line) = serde_json::from_slice(&bytes) else { return Ok(None) };
        let steps = self.label.shard.steps(self.label.steps);
        match &line {
            Line::Step { step, .. } if *step == self.next && *step < steps.end => self.next += 1,
            Line::End { .. } if self.next == steps.end => self.ended = true,
            _ => return Ok(None),
        }
        self.whole += bytes.len() as u64;
        Ok(Some(line))
    }

    /// How many steps are finished.
    pub(crate) fn finished(&self) -> u64 {
        self.next - self.label.shard.steps(self.label.steps).start
    }

    /// Whether the last line was read.
    pub(crate) fn is_complete(&self) -> bool {
        self.ended
    }
}

fn no_journal() -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, "it is no shard of a run of this version")
}

/// Why a journal cannot be written.
#[derive(Debug, thiserror::Error)]
pub(crate) enum JournalError {
    /// Something is wrong with the file.
    #[error("{path}: {source}", path = .path.display())]
    Disk { path: PathBuf, source: io::Error },
    /// Another process writes it.
    #[error("{path} is being written by another process", path = .0.display())]
    Busy(PathBuf),
    /// It has steps of another run.
    #[error(
        "{path} belongs to a run of another program, mode, seed or version: remove it, or give another --job or --out",
        path = .0.display()
    )]
    Foreign(PathBuf),
}

/// A journal that is being written.
pub(crate) struct Journal {
    file: BufWriter<File>,
    /// The first step that is not finished.
    pub(crate) next: u64,
    /// Whether the journal was complete when it was opened.
    pub(crate) complete: bool,
    texts: [String; 3],
}

impl Journal {
    /// Begins the journal `path`, or goes on with it behind its last finished step.
    ///
    /// # Errors
    ///
    /// If it cannot be read or written, another process writes it, or it belongs to another run.
    pub(crate) fn open(path: &Path, label: &Label) -> Result<Self, JournalError> {
        let disk = |source| JournalError::Disk { path: path.to_owned(), source };
        let open =
            OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path);
        let mut file = open.map_err(disk)?;
        file.try_lock().map_err(|_| JournalError::Busy(path.to_owned()))?;
        let reader = file.try_clone().and_then(Reader::new).map_err(disk)?;
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

    /// Says that all steps are there.
    ///
    /// # Errors
    ///
    /// If that cannot be written.
    pub(crate) fn end(mut self, seconds: f64) -> io::Result<()> {
        self.add(&Line::End { seconds })?;
        self.file.flush()?;
        self.file.get_ref().sync_all()
    }

    fn add(&mut self, line: &impl Serialize) -> io::Result<()> {
        let mut text = serde_json::to_vec(line)?;
        text.push(b'\n');
        self.file.write_all(&text)
    }
}

impl Sink for Journal {
    fn write(&mut self, stream: OutputStream, text: &str) -> io::Result<()> {
        self.texts[stream as usize].push_str(text);
        Ok(())
    }

    fn step_done(&mut self, step: u64) -> io::Result<()> {
        let take = |text: &mut String| std::mem::take(text);
        let [results, listing, samples] = self.texts.each_mut().map(take);
        self.add(&Line::Step { step, results, listing, samples })?;
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
