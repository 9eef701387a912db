//! Special functions and quadrature rules that several models need.

pub mod bessel;
pub(crate) mod erf;
pub mod gauss;
pub mod harmonics;
pub mod laguerre;
pub mod riccati;
