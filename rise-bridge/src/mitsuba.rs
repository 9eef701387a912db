//! What Mitsuba 3 reads: its frames, its tables of Mueller matrices and of reflection.

pub mod axes;
pub mod bsdf;
pub mod frame;
pub mod pbsdf;
