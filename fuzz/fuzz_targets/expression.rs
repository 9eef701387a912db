//! Any text as an expression: both dialects and the library's evaluator.
#![no_main]

use libfuzzer_sys::fuzz_target;
use mist_fuzz::laws;

fuzz_target!(|text: &str| laws::expression(text));
