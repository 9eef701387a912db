//! The budget of memory for bodies and for tables that are being made.

use std::sync::{Arc, Mutex, PoisonError};

use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use crate::limits::LimitReached;

/// Memory is counted in blocks of so many bytes.
const BLOCK: usize = 4096;
/// The flag with the limit.
const FLAG: &str = "max-memory";

/// A budget of bytes; clones share it.
#[derive(Clone, Debug)]
pub(crate) struct MemoryBudget {
    free: Arc<Semaphore>,
    blocks: usize,
}

/// A part of the budget, given back when it is dropped.
#[derive(Debug)]
#[must_use]
pub(crate) struct Reservation(
    #[expect(dead_code, reason = "gives back when it is dropped")] OwnedSemaphorePermit,
);

/// Reservations of one request, held until it is answered; clones share them.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeldMemory(Arc<Mutex<Vec<Reservation>>>);

impl HeldMemory {
    /// Holds a reservation.
    pub(crate) fn add(&self, reservation: Reservation) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(reservation);
    }
}

/// The reason why memory cannot be reserved.
#[derive(Debug)]
pub(crate) enum MemoryError {
    /// More than the whole budget.
    TooLarge(LimitReached),
    /// More than is free now.
    Exhausted(LimitReached),
}

impl MemoryBudget {
    /// A budget of `bytes`.
    pub(crate) fn new(bytes: usize) -> Self {
        let blocks = (bytes / BLOCK).clamp(1, u32::MAX as usize);
        Self { free: Arc::new(Semaphore::new(blocks)), blocks }
    }

    /// Takes `bytes` from the budget.
    ///
    /// # Errors
    ///
    /// For more bytes than the budget has, or than are free now.
    pub(crate) fn reserve(&self, bytes: f64) -> Result<Reservation, MemoryError> {
        let value = (self.blocks * BLOCK) as f64;
        let blocks = (bytes / BLOCK as f64).ceil().max(1.0);
        if blocks > self.blocks as f64 {
            let message = format!("this needs about {bytes:.0} bytes of memory, more than {value}");
            return Err(MemoryError::TooLarge(LimitReached { flag: FLAG, value, message }));
        }
        // A number that is not larger than `self.blocks` fits.
        match self.free.clone().try_acquire_many_owned(blocks as u32) {
            Ok(permit) => Ok(Reservation(permit)),
            Err(_) => {
                let message = "other requests hold the memory".into();
                Err(MemoryError::Exhausted(LimitReached { flag: FLAG, value, message }))
            }
        }
    }

    /// Bytes that are reserved.
    pub(crate) fn reserved(&self) -> usize {
        (self.blocks - self.free.available_permits()) * BLOCK
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_the_budget_is_refused_and_more_than_is_free_is_put_off() {
        let memory = MemoryBudget::new(1 << 20);
        assert!(matches!(memory.reserve(2e6), Err(MemoryError::TooLarge(_))));
        assert!(matches!(memory.reserve(1e300), Err(MemoryError::TooLarge(_))));
        let reservation = memory.reserve(6e5).unwrap();
        assert!(matches!(memory.reserve(6e5), Err(MemoryError::Exhausted(_))));
        drop(reservation);
        assert_eq!(memory.reserved(), 0);
        assert!(memory.reserve(6e5).is_ok());
    }
}
