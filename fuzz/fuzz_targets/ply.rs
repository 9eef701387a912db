//! Any bytes as a mesh in a PLY file.
#![no_main]

use libfuzzer_sys::fuzz_target;
use preview::mesh::Mesh;

fuzz_target!(|bytes: &[u8]| {
    let _ = Mesh::from_ply(bytes);
});
