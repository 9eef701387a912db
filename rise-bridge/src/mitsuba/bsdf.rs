//! `.bsdf`: the reflection for unpolarized light in the format of the RGL, for Mitsuba's
//! `measured` and other readers; spectra or linear sRGB.
//!
//! A tensor file with one image over the half vector m per direction of the viewer (θ_i, φ_i). The
//! unit square is x = √(2θ_m/π), y = (φ_m − φ_i + π)/2π, and without rotational symmetry
//! y = (φ_m + π)/2π. A reader takes
//!
//! $$ f \cos\theta_o = \frac{\mathrm{spectra}(x, y)\,\mathrm{ndf}(x, y)}{4\,\sigma} $$
//!
//! where (x, y) is first warped by the density of visible normals `vndf`. We write the identity for
//! it (ones) and for σ, a smooth `ndf` that removes the peak from the images, and a `luminance` from
//! which readers sample directions.
//!
//! J. Dupuy and W. Jakob, *An Adaptive Parameterization for Efficient Material Acquisition and
//! Rendering*, ACM Trans. Graph. 37(6), 274 (2018).

mod interpolation_error;
mod nodes;
mod sampler;
mod size;
mod table;
mod write;

pub use interpolation_error::{choose_size, interpolation_error};
pub use size::{BsdfChannels, BsdfSize};
pub use table::BsdfTable;
pub use write::write;
