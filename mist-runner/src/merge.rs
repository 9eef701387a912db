//! The shards of a run become its table: that of one run, byte by byte.

use std::{
    collections::BTreeMap,
    fs::File,
    io::{self, Write as _},
    path::{Path, PathBuf},
};

use mist_engine::{Job, OutputStream};

use crate::{
    files::{AtomicFile, WrittenFile},
    shard::{JournalLine, JournalReader, Shard, ShardLabel, TextHead},
};

/// Missing shards that a refusal names: a run may have more than anybody wants to read.
const MOST_NAMED: usize = 20;

/// A merged run.
#[derive(Clone, Debug)]
pub struct Merged {
    /// Name of its job.
    pub job: String,
    /// Steps of the whole job.
    pub steps: u64,
    /// Its files.
    pub files: Vec<WrittenFile>,
}

/// Error of merging shards.
#[derive(Debug, thiserror::Error)]
pub enum MergeError {
    /// There is no shard.
    #[error("there is no shard to merge")]
    Nothing,
    /// A file cannot be opened, or is not a shard.
    #[error("cannot read {path}: {source}", path = .path.display())]
    Unusable {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// A shard has not even its label.
    #[error(
        "{path} is incomplete: its run died before the first step; run it again",
        path = .0.display()
    )]
    Unlabelled(PathBuf),
    /// Two shards belong to different runs.
    #[error(
        "{one} and {other} are shards of different runs: of another program, mode, seed, version \
         or number of shards",
        one = .0.display(),
        other = .1.display()
    )]
    DifferentRuns(PathBuf, PathBuf),
    /// Two files are the same shard.
    #[error("{one} and {other} are the same shard", one = .0.display(), other = .1.display())]
    Doubled(PathBuf, PathBuf),
    /// Shards are missing; their names.
    #[error("shards are missing: {}", .0.join(", "))]
    Missing(Vec<String>),
    /// A shard was not run to its end.
    #[error(
        "{path} is incomplete: {finished} of {steps} steps; run its command with --shard {shard} \
         again, it goes on where it stopped",
        path = .path.display()
    )]
    Incomplete {
        /// The file.
        path: PathBuf,
        /// Steps that are finished.
        finished: u64,
        /// Steps of the shard.
        steps: u64,
        /// The shard.
        shard: Shard,
    },
    /// A shard cannot be read any further.
    #[error("cannot read {path}: {source}", path = .path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// A text of the run cannot be written.
    #[error("cannot write {path}: {source}", path = .path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
}

impl MergeError {
    /// True if the shards are at fault, and not a disk.
    pub fn is_refusal(&self) -> bool {
        !matches!(self, Self::Read { .. } | Self::Write { .. })
    }
}

/// Merges the files `shards`, given in any order, into the table `output`: by default the name
/// that the program gives it. Listing and samples are written beside the table.
///
/// # Errors
///
/// If the shards are not all complete shards of one run, or a file cannot be read or written.
pub fn merge(shards: &[PathBuf], output: Option<&Path>) -> Result<Merged, MergeError> {
    let shards = open_all(shards)?;
    let (_, first) = shards.first_key_value().ok_or(MergeError::Nothing)?;
    let label = first.reader.label.clone();
    let table = output.map_or_else(|| PathBuf::from(&label.results.name), Path::to_owned);
    let folder = table.parent().unwrap_or(Path::new("")).to_owned();
    let beside = |head: &TextHead| folder.join(&head.name);
    let mut texts =
        vec![MergedText::begin(OutputStream::Results, "results", &table, &label.results)?];
    let listing = beside(&label.listing);
    texts.push(MergedText::begin(OutputStream::Listing, "listing", &listing, &label.listing)?);
    if let Some(head) = &label.samples {
        texts.push(MergedText::begin(OutputStream::Samples, "samples", &beside(head), head)?);
    }
    let mut seconds = 0.0;
    for shard in shards.into_values() {
        seconds += shard.copy(&mut texts)?;
    }
    let files: Result<_, _> = texts.into_iter().map(|text| text.finish(seconds)).collect();
    Ok(Merged { job: label.job, steps: label.steps, files: files? })
}

/// A shard that is open for reading.
struct OpenShard {
    path: PathBuf,
    reader: JournalReader,
}

/// All shards by their numbers, none missing and all of one run.
fn open_all(paths: &[PathBuf]) -> Result<BTreeMap<u64, OpenShard>, MergeError> {
    let mut shards: BTreeMap<u64, OpenShard> = BTreeMap::new();
    for path in paths {
        let reader = File::open(path)
            .and_then(JournalReader::new)
            .map_err(|source| MergeError::Unusable { path: path.clone(), source })?;
        let reader = reader.ok_or_else(|| MergeError::Unlabelled(path.clone()))?;
        if let Some((_, other)) = shards.first_key_value()
            && !reader.label.is_same_run(&other.reader.label)
        {
            return Err(MergeError::DifferentRuns(path.clone(), other.path.clone()));
        }
        let number = reader.label.shard.number;
        if let Some(other) = shards.get(&number) {
            return Err(MergeError::Doubled(path.clone(), other.path.clone()));
        }
        shards.insert(number, OpenShard { path: path.clone(), reader });
    }
    refuse_missing(&shards)?;
    Ok(shards)
}

fn refuse_missing(shards: &BTreeMap<u64, OpenShard>) -> Result<(), MergeError> {
    let Some((_, first)) = shards.first_key_value() else { return Ok(()) };
    let ShardLabel { job, shard: Shard { of, .. }, .. } = &first.reader.label;
    let missing = (1..=*of).filter(|number| !shards.contains_key(number));
    let names: Vec<String> =
        missing.map(|number| Shard { number, of: *of }.file_name(job)).take(MOST_NAMED).collect();
    if names.is_empty() { Ok(()) } else { Err(MergeError::Missing(names)) }
}

impl OpenShard {
    /// Adds its steps to `texts` and gives the seconds that its last process took.
    fn copy(mut self, texts: &mut [MergedText]) -> Result<f64, MergeError> {
        let mut took = 0.0;
        loop {
            let line = self.reader.next_line();
            match line.map_err(|source| MergeError::Read { path: self.path.clone(), source })? {
                None => break,
                Some(JournalLine::End { seconds }) => took = seconds,
                Some(JournalLine::Step { results, listing, samples, .. }) => {
                    for (text, part) in texts.iter_mut().zip([results, listing, samples]) {
                        text.add(&part)?;
                    }
                }
            }
        }
        if self.reader.is_complete() {
            return Ok(took);
        }
        let label = &self.reader.label;
        let steps = label.shard.steps(label.steps);
        Err(MergeError::Incomplete {
            path: self.path,
            finished: self.reader.finished(),
            steps: steps.end - steps.start,
            shard: label.shard,
        })
    }
}

/// A text of the run that is being written.
struct MergedText {
    stream: OutputStream,
    title: &'static str,
    file: AtomicFile,
}

impl MergedText {
    fn begin(
        stream: OutputStream,
        title: &'static str,
        path: &Path,
        head: &TextHead,
    ) -> Result<Self, MergeError> {
        let file = AtomicFile::create(path).map_err(|source| unwritable(path, source))?;
        let mut text = Self { stream, title, file };
        text.add(&head.head)?;
        Ok(text)
    }

    fn add(&mut self, part: &str) -> Result<(), MergeError> {
        self.file.write_all(part.as_bytes()).map_err(|source| unwritable(self.file.path(), source))
    }

    fn finish(mut self, seconds: f64) -> Result<WrittenFile, MergeError> {
        self.add(&Job::tail(self.stream, seconds))?;
        let path = self.file.path().to_owned();
        let replaces = self.file.finish().map_err(|source| unwritable(&path, source))?;
        Ok(WrittenFile { title: self.title, path, replaces })
    }
}

fn unwritable(path: &Path, source: io::Error) -> MergeError {
    MergeError::Write { path: path.to_owned(), source }
}
