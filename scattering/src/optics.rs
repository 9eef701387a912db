//! Reflection and transmission by interfaces and films, and the optical constants they need.

pub mod film;
pub mod first_order;
mod function;
mod index;

pub use function::{AbscissaScale, FormulaFn, RealFunction, TableInterpolation};
pub use index::{Film, RefractiveIndex};
