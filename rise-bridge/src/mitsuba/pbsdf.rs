//! `.pbsdf`: the Mueller BRDF in half and difference angles, for Mitsuba's `measured_polarized`.
//!
//! A tensor file with M[φ_d, θ_d, θ_h, λ, 4, 4] in 1/sr without a cosine, in the frame of
//! [`frame`](super::frame) (our basis `plane` with the opposite sign of V), and its axes. The table is
//! written in parts. All its numbers are finite: nodes below the horizon are filled
//! ([`node_directions`](super::axes::node_directions)).
//!
//! S.-H. Baek et al., *Image-based acquisition and modeling of polarimetric reflectance*,
//! ACM Trans. Graph. 39(4), 139 (2020).

mod compare;
mod header;
mod interpolation_error;
mod models;
mod nodes;
mod table;
mod write;

pub use compare::{BandDifference, PbsdfComparison, StokesSigns, compare};
pub use interpolation_error::{MuellerInterpolationError, choose_axes, interpolation_error};
pub use models::{STOCK_WAVELENGTHS, bands};
pub use table::PbsdfTable;
pub use write::write;
