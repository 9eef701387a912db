//! Any text as a column table, a LIST file or a formula file.
#![no_main]

use libfuzzer_sys::fuzz_target;
use mist_fuzz::laws;

fuzz_target!(|text: &str| laws::table(text));
