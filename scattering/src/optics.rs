//! Reflection and transmission by interfaces and films, and the material data for them.

pub mod film;
pub mod first_order;
mod index;
mod table;

pub use index::RefractiveIndex;
pub use table::{AbscissaScale, RealFunction, TableInterpolation};
