//! Any text as a colour table `.mtab`.
#![no_main]

use libfuzzer_sys::fuzz_target;
use mist_fuzz::tables;

fuzz_target!(|text: &str| tables::mtab(text));
