//! Klems XML: reflection between 145 × 145 patches of direction, for Radiance and WINDOW.
//!
//! Values are the BRDF in 1/sr without a cosine for unpolarized light: means over the outgoing patch
//! for light from the centre of the incident patch. Radiance reads three bands and no wavelengths:
//! CIE X, Y and Z, here for equal energy, so that a grey material has three equal numbers. Its
//! "Reflection Back" is the side of the normal; the writer gives both sides the same values.
//!
//! J. H. Klems, *A new method for predicting the solar heat gain of complex fenestration systems*,
//! ASHRAE Trans. 100(1) (1994), for the patches.

mod basis;
mod interpolation_error;
mod mean;
mod read;
mod write;

pub use basis::projected_solid_angles;
pub use interpolation_error::interpolation_error;
pub use read::{KlemsBlock, read};
pub use write::write;

#[cfg(test)]
mod tests;
