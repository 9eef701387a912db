//! Conversion of any bytes, read as a document of the Windows program or as a program.
#![no_main]

use libfuzzer_sys::fuzz_target;
use mist_fuzz::laws;

fuzz_target!(|bytes: &[u8]| laws::archive(bytes));
