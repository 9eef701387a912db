//! What interfaces and films do to light, and the material data that enter.

pub mod film;
pub mod first_order;
mod index;
mod table;

pub use index::RefractiveIndex;
pub use table::{AbscissaScale, RealFunction, TableInterpolation};
