//! Amplitude coefficients and tangential fields of s and p waves.

use num_complex::Complex64;

use crate::Jones;

/// A pair of amplitude coefficients.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpAmplitudes {
    /// For s.
    pub s: Complex64,
    /// For p.
    pub p: Complex64,
}

impl SpAmplitudes {
    /// The Jones matrix that is diagonal with these elements.
    pub fn jones(self) -> Jones {
        Jones::diagonal(self.s, self.p)
    }
}

/// Tangential fields at a depth, driven by a unit plane wave (E = 1 for s, H = 1 for p).
///
/// The normal displacement of p is D = κU. For a unit **electric** p wave in a medium of index n
/// multiply `u` and `w` by n.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TangentialFields {
    /// Electric field of s.
    pub e: Complex64,
    /// Magnetic field of p.
    pub u: Complex64,
    /// Tangential electric field of p.
    pub w: Complex64,
}

/// A wave that meets the stack, by the side it comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IncidentSide {
    /// From the outer medium: "12".
    FromOutside,
    /// From the substrate: "21".
    FromSubstrate,
}

impl TangentialFields {
    #[inline]
    pub(super) fn scaled(&self, amplitude: SpAmplitudes, phase: Complex64) -> Self {
        let (s, p) = (amplitude.s * phase, amplitude.p * phase);
        Self { e: self.e * s, u: self.u * p, w: self.w * p }
    }
}
