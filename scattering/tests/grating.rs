//! Gratings by coupled waves, against NIST's tables, against published efficiencies, and against
//! the laws that hold for every grating.

#[path = "grating/laws.rs"]
mod laws;
#[path = "grating/nist.rs"]
mod nist;
#[path = "grating/parts.rs"]
mod parts;
#[path = "grating/published.rs"]
mod published;
