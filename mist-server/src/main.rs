//! The program `mist`.

fn main() {}
