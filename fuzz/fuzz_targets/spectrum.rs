//! Any text as a spectrum: a file of two columns, or `.mspd`.
#![no_main]

use libfuzzer_sys::fuzz_target;
use mist_fuzz::{spectrum, tables};

fuzz_target!(|text: &str| {
    spectrum::is_a_grid(text);
    tables::mspd(text);
});
