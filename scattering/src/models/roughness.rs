//! First-order scattering by rough interfaces.
//!
//! All models share the spatial frequency that a pair of directions selects. With the index
//! m_i = n of the substrate for types 2 and 3, else 1, and m_s = n for types 1 and 2, else 1,
//!
//! $$ f_x = \frac{m_s \sin\theta_s \cos\varphi_s - m_i \sin\theta_i}{\lambda}, \quad
//!    f_y = \frac{m_s \sin\theta_s \sin\varphi_s}{\lambda} $$
//!
//! turned into the frame of the sample. The amplitudes of the models are per √PSD, so that the
//! Mueller matrix is PSD times that of the amplitude. First order means heights well below the
//! wavelength; neither the specular beam nor multiple scattering is included.

use super::brdf::Brdf;
use crate::spec::Spec;

mod coherent;
pub mod correlated_film;
pub mod correlated_stack;
pub mod growth_stack;
mod interfaces;
pub mod microroughness;
pub mod one_interface;
mod rough_surface;
pub mod two_face;
pub mod uncorrelated_stack;

pub use rough_surface::ROUGHNESS;
use rough_surface::{RoughSurface, STACK, thickness};

/// The models of this group, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Brdf>] = &[
    &microroughness::SPEC,
    &one_interface::SPEC,
    &correlated_stack::SPEC,
    &uncorrelated_stack::SPEC,
    &growth_stack::SPEC,
    &correlated_film::SPEC,
    &two_face::SPEC,
];
