//! Cancellation of work whose client has gone.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use mist_engine::Control;

/// Cancels its work when it is dropped, because the answer is not awaited any more.
#[derive(Default)]
pub(super) struct CancelOnDrop(Arc<AtomicBool>);

impl CancelOnDrop {
    /// The control of the work.
    pub(super) fn control(&self) -> Control {
        Control { cancel: self.0.clone(), progress: None }
    }
}

impl Drop for CancelOnDrop {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}
