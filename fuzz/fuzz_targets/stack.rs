//! Any text as a film stack.
#![no_main]

use libfuzzer_sys::fuzz_target;
use mist_fuzz::laws;

fuzz_target!(|text: &str| laws::stack(text));
