//! Spectral goniometer tables in the forms that optics programs read: writer and reader.
//!
//! Every row is a pair of directions with the BRDF (1/sr, no cosine) for unpolarized light. Azimuths
//! are those of vectors away from the surface. The azimuth of the light is 180°, so 0° is the side
//! of the specular reflection.
//!
//! | form | angles | rows | columns |
//! | --- | --- | --- | --- |
//! | [`GoniometerForm::OpenMaterial`] | radians | λ slowest, φ fastest | λ in m, θ_i, θ_o, φ_o, f |
//! | [`GoniometerForm::Astm`] | radians | θ_i slowest, φ fastest | θ_i, φ_i, θ_s, φ_s, one per wavelength |
//! | [`GoniometerForm::Ocean`] | degrees | the same | the same |

mod interpolation_error;
mod layout;
mod read;
mod write;

pub use interpolation_error::{choose_axes, interpolation_error};
pub use layout::{GoniometerAxes, GoniometerForm};
pub use read::{GoniometerRow, GoniometerTable, read};
pub use write::write;
