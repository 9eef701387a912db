//! Special functions, quadrature rules and matrices.

pub mod bessel;
pub(crate) mod erf;
pub mod extended;
pub mod gauss;
pub mod harmonics;
pub mod laguerre;
pub mod matrix;
pub mod riccati;
