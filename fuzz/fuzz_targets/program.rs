//! Any text as a program: read, refused with places, or printed without loss.
#![no_main]

use libfuzzer_sys::fuzz_target;
use mist_fuzz::laws;

fuzz_target!(|text: &str| laws::program(text));
