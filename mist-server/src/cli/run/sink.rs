//! The texts of a run on their way into files.

use std::{
    io::{self, Write},
    path::{Path, PathBuf},
};

use mist_engine::{Job, OutputStream, Sink};

use crate::disk::WholeFile;

/// Results, listing and samples of one job; on disk under their names only when all are whole.
pub(super) struct DiskSink {
    results: WholeFile,
    listing: WholeFile,
    samples: Option<WholeFile>,
}

impl DiskSink {
    /// Begins the files that `job` writes, below `out`.
    pub(super) fn create(job: &Job, out: &Path) -> Result<Self, String> {
        let create = |name: &str| {
            let path = out.join(name);
            WholeFile::create(&path)
                .map_err(|error| format!("cannot write {}: {error}", path.display()))
        };
        Ok(Self {
            results: create(&job.results_name())?,
            listing: create(&job.listing_name())?,
            samples: job.samples_name().map(create).transpose()?,
        })
    }

    /// Gives the files their names.
    pub(super) fn finish(self) -> Result<Vec<(&'static str, PathBuf)>, String> {
        let named = [
            Some(("results", self.results)),
            Some(("listing", self.listing)),
            self.samples.map(|samples| ("samples", samples)),
        ];
        let finish = |(what, file): (_, WholeFile)| {
            let path = file.path().to_owned();
            let done = file.finish();
            done.map_err(|error| format!("cannot write {}: {error}", path.display()))?;
            Ok((what, path))
        };
        named.into_iter().flatten().map(finish).collect()
    }
}

impl Sink for DiskSink {
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
