//! Transition matrices: how a particle answers the multipoles of the light around it.
//!
//! The field of every multipole (l, m) derives from u = z_l(kr) P̃_l^m(cos θ) e^{imφ}: an electric
//! one e = ∇×∇×(**r**u) and a magnetic one h = ik∇×(**r**u), regular with z = j and outgoing with
//! z = h⁽¹⁾. A body of revolution about the axis of θ answers regular waves of the order m with
//! outgoing ones of the same order, $$ \mathbf{w}_m = \mathbf{T}_m \mathbf{v}_m $$ and T_{−m} is T_m
//! with the sign of the elements between e and h changed. Within a block the electric multipoles
//! come first, each kind with l from max(1, m) up.
//!
//! P. C. Waterman, Phys. Rev. D 3, 825 (1971); M. I. Mishchenko, L. D. Travis and A. A. Lacis,
//! *Scattering, Absorption, and Emission of Light by Small Particles* (Cambridge, 2002).

mod blocks;
mod build;
pub(crate) mod converged;
pub mod ebcm;
pub(crate) mod mispairing;
mod parameters;
pub mod spheroid;
pub mod waves;

pub use blocks::{MOST, TMatrix};
pub(crate) use blocks::{apply, is_finite, solve};
pub(crate) use build::read;
pub(crate) use parameters::{BODY, MULTIPOLES, l_max, m_max, terms};

pub use crate::special::matrix::ComplexMatrix;
