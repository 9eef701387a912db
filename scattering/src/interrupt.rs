//! Interruption of long computations from another thread.
//!
//! [`until`] runs a computation with a flag. Solvers call [`check`] between operations that take
//! milliseconds; once the flag is set, `check` unwinds to `until` without a message, as a panic
//! does with its payload, and `until` returns [`Interrupted`]. Results do not change, and code
//! between the two needs no error of its own. Locks that are held at a `check` must survive a
//! panic. Without `until` a `check` does nothing.

use std::{
    cell::RefCell,
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

thread_local! {
    /// The flag of the innermost computation on this thread.
    static FLAG: RefCell<Option<Arc<AtomicBool>>> = const { RefCell::new(None) };
}

/// The computation was interrupted and has no result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("interrupted")]
pub struct Interrupted;

/// Runs `work` until it is done or `flag` is set.
///
/// Threads to which `work` gives parts of it have to [`follow`] the same flag.
///
/// # Errors
///
/// If the flag was set at a [`check`].
pub fn until<T>(flag: &Arc<AtomicBool>, work: impl FnOnce() -> T) -> Result<T, Interrupted> {
    let before = replace(Some(flag.clone()));
    let done = catch_unwind(AssertUnwindSafe(|| {
        check();
        work()
    }));
    replace(before);
    done.map_err(|payload| match payload.downcast::<Interrupted>() {
        Ok(interrupted) => *interrupted,
        Err(other) => resume_unwind(other),
    })
}

/// Makes `flag` the flag of this thread, which works for a computation of another thread; none
/// when the computation is over.
pub fn follow(flag: Option<Arc<AtomicBool>>) {
    replace(flag);
}

/// Ends the computation of this thread if its flag is set.
#[inline]
pub fn check() {
    let is_set =
        FLAG.with_borrow(|flag| flag.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed)));
    if is_set {
        resume_unwind(Box::new(Interrupted));
    }
}

fn replace(flag: Option<Arc<AtomicBool>>) -> Option<Arc<AtomicBool>> {
    FLAG.with_borrow_mut(|own| std::mem::replace(own, flag))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_computation_ends_at_the_next_check_after_its_flag_is_set() {
        let flag = Arc::new(AtomicBool::new(false));
        let mut steps = 0;
        let found = until(&flag, || {
            for step in 0..10 {
                flag.store(step == 3, Ordering::Relaxed);
                check();
                steps += 1;
            }
        });
        assert_eq!((found, steps), (Err(Interrupted), 3));
        check();
        flag.store(false, Ordering::Relaxed);
        assert_eq!(until(&flag, || 7), Ok(7));
    }

    #[test]
    fn the_flag_of_an_inner_computation_does_not_end_the_outer_one() {
        let (outer, inner) = (Arc::default(), Arc::new(AtomicBool::new(true)));
        let found = until(&outer, || {
            let found = until(&inner, || 1);
            check();
            found
        });
        assert_eq!(found, Ok(Err(Interrupted)));
    }
}
