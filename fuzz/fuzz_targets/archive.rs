//! Any bytes as a document of the Windows program, or a program, to be converted.
#![no_main]

use libfuzzer_sys::fuzz_target;
use mist_fuzz::laws;

fuzz_target!(|bytes: &[u8]| laws::archive(bytes));
