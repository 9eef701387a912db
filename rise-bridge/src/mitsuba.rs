//! Formats of Mitsuba 3: its Stokes bases, tables of Mueller matrices and tables of reflection.

pub mod axes;
pub mod bsdf;
pub mod frame;
pub mod pbsdf;
