//! The real service on loopback: crashes, stops, faults, and the examples of `docs/http.md`.

mod examples;
mod faults;
mod restarts;
mod service;
