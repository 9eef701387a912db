//! What interfaces and films do to light, and the material data that enter.

pub mod film;
mod index;
mod table;

pub use index::Index;
pub use table::{Axis, Rise, Table};
