//! Coherent reflection, transmission and fields of a stack of films between two media.
//!
//! Every quantity depends on the tangential index κ = n sin θ, which all media share. With
//! q = √(n² − κ²) (= n cos θ), a film of thickness t has the phase δ = 2πtq/λ, the admittance
//! Y = q for s and q/n² for p, and carries the vector (1, Y) of its two tangential fields by
//!
//! $$ F = \begin{pmatrix} \cos\delta & -(i/Y)\sin\delta \\ -iY\sin\delta & \cos\delta \end{pmatrix} $$
//!
//! from its far face to its near face. From the exit medium inwards, v = F…F(1, Y_t), and with
//! X = v₁Y₀ and Z = v₂
//!
//! $$ r = \frac{X-Z}{X+Z}, \quad t_s = \frac{2Y_0}{X+Z}, \quad
//!    t_p = \frac{n_0}{n_t}\frac{2Y_0}{X+Z} $$
//!
//! Where the wave fades, F is used times e^{iδ}, so that thick films do not overflow; the product
//! of these factors enters transmission and fields. A wave that travels without loss has real δ and
//! Y, and its F has two real and two imaginary elements.
//!
//! M. Born and E. Wolf, *Principles of Optics*, 7th ed. (1999), section 1.6.

mod amplitudes;
mod clear;
mod clear_fields;
mod films;
mod layer;
mod root;
#[cfg(test)]
mod tests;
mod vectors;

pub use amplitudes::{IncidentSide, SpAmplitudes, TangentialFields};
pub use films::Films;
pub use root::decaying_root;
pub(crate) use root::root;
