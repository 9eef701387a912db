//! Signatures of instruments and tabulated standards.

use super::brdf::Brdf;
use crate::spec::Spec;

mod disk;
pub mod finite_aperture;
pub mod focussed_beam;
pub mod rayleigh_air;
pub mod zernike;

/// The models of this group, in the order they are listed to users.
pub const ALL: &[&Spec<dyn Brdf>] =
    &[&rayleigh_air::SPEC, &finite_aperture::SPEC, &focussed_beam::SPEC, &zernike::SPEC];
