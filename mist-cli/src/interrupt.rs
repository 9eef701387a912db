//! Ctrl-C and SIGTERM stop the work in order: temporary files go, nothing half-written stays.

use std::sync::{Arc, atomic::AtomicBool};

use signal_hook::{
    consts::{SIGINT, SIGTERM},
    flag::{register, register_conditional_shutdown},
};

/// Exit code of a process that was asked twice: that of a shell for Ctrl-C.
const STOPPED_AT_ONCE: i32 = 130;

/// A flag that becomes true when the process is asked to stop; a second time it stops at once.
///
/// No thread waits for it: short runs would feel that.
pub(crate) fn flag() -> Arc<AtomicBool> {
    let flag = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        // Where the system refuses, the process ends at once, with its temporary files left.
        let _ = register_conditional_shutdown(signal, STOPPED_AT_ONCE, flag.clone())
            .and_then(|_| register(signal, flag.clone()));
    }
    flag
}
