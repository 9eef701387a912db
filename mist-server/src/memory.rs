//! What bodies and large orders may hold in memory together.

use std::sync::Arc;

use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use crate::http::{ApiError, Limit};

/// Memory is counted in pieces of so many bytes.
const PIECE: usize = 4096;
/// The flag with the bound.
const FLAG: &str = "max-memory";

/// A budget; clones share it.
#[derive(Clone, Debug)]
pub(crate) struct Memory {
    free: Arc<Semaphore>,
    pieces: usize,
}

/// A part of the budget, until it is dropped.
#[derive(Debug)]
#[must_use]
pub(crate) struct Reserved(
    #[expect(dead_code, reason = "gives back when it is dropped")] OwnedSemaphorePermit,
);

impl Memory {
    /// A budget of `bytes`.
    pub(crate) fn new(bytes: usize) -> Self {
        let pieces = (bytes / PIECE).clamp(1, u32::MAX as usize);
        Self { free: Arc::new(Semaphore::new(pieces)), pieces }
    }

    /// Takes `bytes` from the budget.
    ///
    /// # Errors
    ///
    /// [`ApiError::Limit`] for more than there will ever be, [`ApiError::Busy`] for more than
    /// there is now.
    pub(crate) fn reserve(&self, bytes: f64) -> Result<Reserved, ApiError> {
        let value = (self.pieces * PIECE) as f64;
        let pieces = (bytes / PIECE as f64).ceil().max(1.0);
        if pieces > self.pieces as f64 {
            let message = format!("this needs about {bytes:.0} bytes of memory, more than {value}");
            return Err(ApiError::Limit(Limit { flag: FLAG, value, message }));
        }
        // A number that is not larger than the pieces fits.
        match self.free.clone().try_acquire_many_owned(pieces as u32) {
            Ok(permit) => Ok(Reserved(permit)),
            Err(_) => {
                let message = "other requests hold the memory".into();
                Err(ApiError::Busy(Limit { flag: FLAG, value, message }))
            }
        }
    }

    /// Bytes that are held.
    pub(crate) fn held(&self) -> usize {
        (self.pieces - self.free.available_permits()) * PIECE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_never_fits_is_refused_and_what_does_not_fit_now_is_put_off() {
        let memory = Memory::new(1 << 20);
        assert!(matches!(memory.reserve(2e6), Err(ApiError::Limit(_))));
        assert!(matches!(memory.reserve(1e300), Err(ApiError::Limit(_))));
        let held = memory.reserve(6e5).unwrap();
        assert!(matches!(memory.reserve(6e5), Err(ApiError::Busy(_))));
        drop(held);
        assert_eq!(memory.held(), 0);
        assert!(memory.reserve(6e5).is_ok());
    }
}
