//! Any text as optical constants or a table parameter.
#![no_main]

use libfuzzer_sys::fuzz_target;
use mist_fuzz::laws;

fuzz_target!(|text: &str| laws::optics(text));
