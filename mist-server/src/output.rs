//! The texts of a run in memory, up to a length.

use std::io;

use mist_engine::{OutputStream, Sink};

use crate::limits::LimitReached;

/// Results, listing and samples of a run, up to a length.
#[derive(Clone, Debug, Default)]
pub(crate) struct BoundedOutput {
    /// The table.
    pub(crate) results: String,
    /// The listing.
    pub(crate) listing: String,
    /// The samples.
    pub(crate) samples: String,
    max_bytes: usize,
}

/// Error of [`BoundedOutput`]: the texts are longer than allowed.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{}", .0.message)]
pub(crate) struct OutputTooLong(pub(crate) LimitReached);

impl BoundedOutput {
    /// Room for `max_bytes` bytes.
    pub(crate) fn new(max_bytes: usize) -> Self {
        Self { max_bytes, ..Self::default() }
    }
}

impl Sink for BoundedOutput {
    fn write(&mut self, stream: OutputStream, text: &str) -> io::Result<()> {
        let bytes = self.results.len() + self.listing.len() + self.samples.len() + text.len();
        if bytes > self.max_bytes {
            let message = format!("the results are longer than {} bytes", self.max_bytes);
            let limit = LimitReached { flag: "max-output", value: self.max_bytes as f64, message };
            return Err(io::Error::other(OutputTooLong(limit)));
        }
        let text_so_far = match stream {
            OutputStream::Results => &mut self.results,
            OutputStream::Listing => &mut self.listing,
            OutputStream::Samples => &mut self.samples,
        };
        text_so_far.push_str(text);
        Ok(())
    }
}
