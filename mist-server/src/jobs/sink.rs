//! The texts of a run in memory, up to a length.

use std::io;

use mist_engine::{OutputStream, Sink};

use crate::http::{Limit, OutputLimit};

/// Results, listing and samples, and how long they may be.
#[derive(Clone, Debug, Default)]
pub(crate) struct MeasuredSink {
    /// The table.
    pub(crate) results: String,
    /// The listing.
    pub(crate) listing: String,
    /// The samples.
    pub(crate) samples: String,
    most: usize,
}

impl MeasuredSink {
    /// Room for `most` bytes.
    pub(crate) fn new(most: usize) -> Self {
        Self { most, ..Self::default() }
    }
}

impl Sink for MeasuredSink {
    fn write(&mut self, stream: OutputStream, text: &str) -> io::Result<()> {
        let bytes = self.results.len() + self.listing.len() + self.samples.len() + text.len();
        if bytes > self.most {
            let message = format!("the results are longer than {} bytes", self.most);
            let limit = Limit { flag: "max-output", value: self.most as f64, message };
            return Err(io::Error::other(OutputLimit(limit)));
        }
        let kept = match stream {
            OutputStream::Results => &mut self.results,
            OutputStream::Listing => &mut self.listing,
            OutputStream::Samples => &mut self.samples,
        };
        kept.push_str(text);
        Ok(())
    }
}
