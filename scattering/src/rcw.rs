//! Rigorous coupled-wave analysis: diffraction of a plane wave by a periodic layered structure.
//!
//! Lengths are in 1/k₀; fields are sums of e^{i(k_x x + k_y y)} over the harmonics of the structure.
//! With U = (E_x, E_y) and V = (H_y, −H_x), Maxwell's equations in a layer are
//!
//! $$ U' = iPV, \qquad V' = iQU, \qquad U'' = -PQ\,U \qquad (1) $$
//!
//! (z upwards; [`layer`] has P and Q). For waves across the lines, k_y = 0, they separate into
//! E_y (s) and H_y (p). Every layer becomes a pair of reflection and transmission matrices ([`slab`]),
//! and layers are added from the substrate upwards. Only decaying waves occur, so thick and metallic
//! layers are as stable as thin ones. No eigenvalue problem is solved.
//!
//! M. G. Moharam, E. B. Grann, D. A. Pommet, T. K. Gaylord, J. Opt. Soc. Am. A 12, 1068 (1995);
//! P. Lalanne, G. M. Morris, J. Opt. Soc. Am. A 13, 779 (1996); L. Li, J. Opt. Soc. Am. A 13,
//! 1870 (1996) for the factorization.

mod dense;
pub mod layer;
pub mod slab;
mod structure;
pub mod toeplitz;

pub use structure::{DiffractionOrder, IncidentWave, PeriodicStructure};

pub use crate::special::matrix::ComplexMatrix;
