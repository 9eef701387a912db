//! Any text as a program for `mist check`: compiled, or refused with places.
#![no_main]

use libfuzzer_sys::fuzz_target;
use mist_fuzz::check;

fuzz_target!(|text: &str| check::compiles_or_says_why(text));
