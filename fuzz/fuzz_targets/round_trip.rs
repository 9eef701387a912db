//! Texts that resemble programs: printing and reading again preserves them.
#![no_main]

use libfuzzer_sys::fuzz_target;
use mist_fuzz::{laws, likely};

fuzz_target!(|bytes: &[u8]| laws::program(&likely::program(bytes)));
