//! From spectra to XYZ, and chromaticity.
//!
//! For a reflectance R under an illuminant S, on the 1 nm grid from 360 to 830 nm,
//!
//! XYZ = Σ R S c̄ / Σ S ȳ,
//!
//! so that a perfect diffuser has Y = 1; for a spectral radiance L in W/(m² sr nm)
//! XYZ = 683 Σ L c̄, with Y in cd/m². R may be signed (a Stokes component) and above one (a BRDF).
//!
//! CIE 015:2018, *Colorimetry*, 4th edition, section 7.

mod sum;
mod value;

pub use sum::{LUMINOUS_EFFICACY, emitted, reflected};
pub use value::{Xyz, chromaticity, from_chromaticity};

pub(crate) use value::{from_array, to_array};
