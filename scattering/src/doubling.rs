//! Radiative transfer in coatings with polarization: adding and doubling of slabs and interfaces.
//!
//! Light is a Stokes vector at [`nodes`] of the tangential index, which all media share, in
//! independent [`block`]s, one or two for each azimuthal mode. A [`slab`] of scatterers
//! ([`expansion`], [`phase_matrix`], [`wigner`]) and [`flakes`] is doubled from a thin part of it.
//! [`operator`] adds slabs, smooth [`interface`]s, [`rough`] interfaces (with all bounces:
//! [`heights`]) and the bottom to a [`stack`]. The [`diffuse`] reflection becomes a [`table`] that is
//! interpolated in both angles; light scattered once ([`single`], [`phase_table`]) is added exactly.
//!
//! J. F. de Haan, P. B. Bosma and J. W. Hovenier, Astron. Astrophys. 183, 371 (1987); H. C. van de
//! Hulst, *Multiple Light Scattering* (Academic Press, 1980).

pub mod azimuth;
pub mod block;
pub mod diffuse;
pub mod energy_balance;
pub mod expansion;
pub mod facet;
mod facet_media;
pub mod flakes;
pub mod heights;
pub mod interface;
pub mod kernel_cache;
pub mod nodes;
pub mod operator;
pub mod phase_matrix;
pub mod phase_table;
pub mod rough;
pub mod scaling;
pub mod single;
pub mod slab;
pub mod slopes;
pub mod stack;
pub mod table;
pub mod wigner;

#[cfg(test)]
mod tests;
