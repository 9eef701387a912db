//! `mist merge`: the shards of a run become its table.

use std::{
    collections::BTreeMap,
    fmt::Write as _,
    fs::File,
    io::Write as _,
    path::{Path, PathBuf},
};

use mist_engine::{Job, OutputStream};

use super::{Stop, print};
use crate::{
    disk::WholeFile,
    shard::{Head, Label, Line, Reader, Shard},
};

/// Put the shards of a run together: the table is that of one run, byte by byte.
///
/// The listing and the samples, if the program has any, are written beside the table under the
/// names that the program gives them.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist merge paint.*-of-4 -o paint.dat
  mist run --shard 1/2 paint.mist && mist run --shard 2/2 paint.mist && mist merge paint.*-of-2")]
pub(super) struct Args {
    /// All shards of one run, in any order.
    #[arg(required = true)]
    shards: Vec<PathBuf>,
    /// The table [default: the name that the program gives it].
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Writes table, listing and samples.
pub(super) fn merge(args: &Args) -> Result<(), Stop> {
    let shards = open_all(&args.shards)?;
    let (_, first) = shards.first_key_value().expect("at least one shard is required");
    let label = first.reader.label.clone();
    let table = args.output.clone().unwrap_or_else(|| PathBuf::from(&label.results.name));
    let folder = table.parent().unwrap_or(Path::new("")).to_owned();
    let beside = |head: &Head| folder.join(&head.name);
    let mut texts = vec![Text::begin(OutputStream::Results, "results", &table, &label.results)?];
    texts.push(Text::begin(
        OutputStream::Listing,
        "listing",
        &beside(&label.listing),
        &label.listing,
    )?);
    if let Some(head) = &label.samples {
        texts.push(Text::begin(OutputStream::Samples, "samples", &beside(head), head)?);
    }
    let mut seconds = 0.0;
    for shard in shards.into_values() {
        seconds += shard.copy(&mut texts)?;
    }
    let mut said = format!("{}: {} steps\n", label.job, label.steps);
    for text in texts {
        let (what, path) = text.finish(seconds)?;
        // Writing to a string cannot fail.
        let _ = writeln!(said, "  {what:<14} {}", path.display());
    }
    print(&said)
}

/// An open shard.
struct Opened {
    path: PathBuf,
    reader: Reader,
}

/// All shards by their numbers, none missing and all of one run.
fn open_all(paths: &[PathBuf]) -> Result<BTreeMap<u64, Opened>, Stop> {
    let mut shards: BTreeMap<u64, Opened> = BTreeMap::new();
    for path in paths {
        let shown = path.display();
        let reader = File::open(path)
            .and_then(Reader::new)
            .map_err(|error| Stop::Refused(format!("cannot read {shown}: {error}")))?;
        let Some(reader) = reader else {
            return Err(Stop::Refused(format!(
                "{shown} is incomplete: its run died before the first step; run it again"
            )));
        };
        if let Some((_, other)) = shards.first_key_value() {
            same_run(path, &reader.label, other)?;
        }
        let number = reader.label.shard.number;
        if let Some(other) = shards.get(&number) {
            let other = other.path.display();
            return Err(Stop::Refused(format!("{shown} and {other} are the same shard")));
        }
        shards.insert(number, Opened { path: path.clone(), reader });
    }
    all_there(&shards)?;
    Ok(shards)
}

fn same_run(path: &Path, label: &Label, other: &Opened) -> Result<(), Stop> {
    if label.is_of_the_run_of(&other.reader.label) {
        return Ok(());
    }
    Err(Stop::Refused(format!(
        "{} and {} are shards of different runs: of another program, mode, seed, version or \
         number of shards",
        path.display(),
        other.path.display()
    )))
}

fn all_there(shards: &BTreeMap<u64, Opened>) -> Result<(), Stop> {
    let Some((_, first)) = shards.first_key_value() else { return Ok(()) };
    let Label { job, shard: Shard { of, .. }, .. } = &first.reader.label;
    let missing = (1..=*of).filter(|number| !shards.contains_key(number));
    // A run may have more shards than anybody wants to read.
    let names: Vec<String> =
        missing.map(|number| Shard { number, of: *of }.file_name(job)).take(20).collect();
    if names.is_empty() {
        return Ok(());
    }
    Err(Stop::Refused(format!("shards are missing: {}", names.join(", "))))
}

impl Opened {
    /// Adds its steps to `texts` and gives the seconds it took.
    fn copy(mut self, texts: &mut [Text]) -> Result<f64, Stop> {
        let mut took = 0.0;
        let shown = self.path.display().to_string();
        let failed = |error| Stop::Failed(format!("cannot read {shown}: {error}"));
        while let Some(line) = self.reader.next_line().map_err(failed)? {
            match line {
                Line::End { seconds } => took = seconds,
                Line::Step { results, listing, samples, .. } => {
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
        Err(Stop::Refused(format!(
            "{shown} is incomplete: {} of {} steps; run its command with --shard {} again, it goes \
             on where it stopped",
            self.reader.finished(),
            steps.end - steps.start,
            label.shard
        )))
    }
}

/// One of the texts of the run on its way to disk.
struct Text {
    stream: OutputStream,
    title: &'static str,
    file: WholeFile,
}

impl Text {
    fn begin(
        stream: OutputStream,
        title: &'static str,
        path: &Path,
        head: &Head,
    ) -> Result<Self, Stop> {
        let file = WholeFile::create(path).map_err(|error| unwritable(path, &error))?;
        let mut text = Self { stream, title, file };
        text.add(&head.head)?;
        Ok(text)
    }

    fn add(&mut self, part: &str) -> Result<(), Stop> {
        self.file.write_all(part.as_bytes()).map_err(|error| unwritable(self.file.path(), &error))
    }

    fn finish(mut self, seconds: f64) -> Result<(&'static str, PathBuf), Stop> {
        self.add(&Job::tail(self.stream, seconds))?;
        let path = self.file.path().to_owned();
        self.file.finish().map_err(|error| unwritable(&path, &error))?;
        Ok((self.title, path))
    }
}

fn unwritable(path: &Path, error: &std::io::Error) -> Stop {
    Stop::Failed(format!("cannot write {}: {error}", path.display()))
}
