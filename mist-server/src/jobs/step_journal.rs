//! Writes the finished steps of a job into the store, and reads them back.

use std::{
    io,
    time::{Duration, Instant},
};

use mist_engine::{Evaluated, Journal, StepResult};

use crate::store::Store;

/// Steps are stored together after this time: the work that a crash can cost.
const MAX_DELAY: Duration = Duration::from_millis(200);
/// Steps are stored together when they have so many bytes.
const MAX_BYTES: usize = 4 << 20;
/// Bytes of a number.
const NUMBER: usize = 8;

/// The steps of one job.
pub(super) struct StepJournal<'a> {
    store: &'a Store,
    id: &'a str,
    /// True as long as the store may have the next step.
    recalling: bool,
    /// Number of steps that the store had.
    pub(super) recalled: u64,
    first: u64,
    pending: Vec<Vec<u8>>,
    bytes: usize,
    stored_at: Instant,
}

impl<'a> StepJournal<'a> {
    pub(super) fn new(store: &'a Store, id: &'a str) -> Self {
        Self {
            store,
            id,
            recalling: true,
            recalled: 0,
            first: 0,
            pending: Vec::new(),
            bytes: 0,
            stored_at: Instant::now(),
        }
    }

    /// Stores the pending steps.
    ///
    /// # Errors
    ///
    /// If they cannot be stored.
    pub(super) fn flush(&mut self) -> io::Result<()> {
        if !self.pending.is_empty() {
            self.store.put_steps(self.id, self.first, &self.pending)?;
            self.pending.clear();
            self.bytes = 0;
        }
        self.stored_at = Instant::now();
        Ok(())
    }
}

impl Journal for StepJournal<'_> {
    fn recall(&mut self, step: u64) -> io::Result<Option<StepResult>> {
        if !self.recalling {
            return Ok(None);
        }
        let found = self.store.step(self.id, step)?.and_then(|bytes| decode(&bytes));
        match found {
            Some(_) => self.recalled += 1,
            None => self.recalling = false,
        }
        Ok(found)
    }

    fn keep(&mut self, first: u64, steps: &[StepResult]) -> io::Result<()> {
        if self.pending.is_empty() {
            self.first = first;
        }
        for step in steps {
            let bytes = encode(step);
            self.bytes += bytes.len();
            self.pending.push(bytes);
        }
        if self.bytes >= MAX_BYTES || self.stored_at.elapsed() >= MAX_DELAY {
            self.flush()?;
        }
        Ok(())
    }
}

/// The number of integrals, their values and errors, the samples.
fn encode(step: &StepResult) -> Vec<u8> {
    let count = step.values.len() as u64;
    let pairs = step.values.iter().flat_map(|integral| [integral.value, integral.error]);
    let values = pairs.flat_map(f64::to_le_bytes);
    count.to_le_bytes().into_iter().chain(values).chain(step.samples.bytes()).collect()
}

fn decode(bytes: &[u8]) -> Option<StepResult> {
    let (count, rest) = bytes.split_at_checked(NUMBER)?;
    let count = usize::try_from(u64::from_le_bytes(count.try_into().ok()?)).ok()?;
    let (values, samples) = rest.split_at_checked(count.checked_mul(2 * NUMBER)?)?;
    let number = |bytes: &[u8]| bytes.try_into().ok().map(f64::from_le_bytes);
    let integral = |bytes: &[u8]| {
        let (value, error) = bytes.split_at_checked(NUMBER)?;
        Some(Evaluated { value: number(value)?, error: number(error)? })
    };
    let values: Option<_> = values.chunks(2 * NUMBER).map(integral).collect();
    Some(StepResult { values: values?, samples: String::from_utf8(samples.to_vec()).ok()? })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_comes_back_to_the_bit() {
        let step = StepResult {
            values: vec![
                Evaluated { value: 0.1 + 0.2, error: -0.0 },
                Evaluated { value: f64::INFINITY, error: f64::from_bits(1) },
            ]
            .into(),
            samples: "0\t1\n".into(),
        };
        let back = decode(&encode(&step)).unwrap();
        let bits = |step: &StepResult| {
            let pairs = step.values.iter().map(|x| (x.value.to_bits(), x.error.to_bits()));
            pairs.collect::<Vec<_>>()
        };
        assert_eq!((bits(&back), back.samples), (bits(&step), step.samples));
        assert_eq!(decode(&[1, 0]), None);
        assert_eq!(decode(&u64::MAX.to_le_bytes()), None);
    }
}
