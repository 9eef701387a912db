//! The one place that says what the engine does differently under compat.
//!
//! How texts are read is decided in `mist-format` ([`mist_format::dialect::TextDeviation`]), what models
//! compute in `scattering` ([`scattering::Defect`]); this is the rest: loops, sending of
//! parameters, apertures.

use mist_format::Dialect;
use scattering::Mode;

/// A habit of NIST's MIST that only compat reproduces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Quirk {
    /// A FOR loop with a negative last value never reaches it: the end test is relative.
    LostNegativeEnd,
    /// A sub-parameter is not sent again when its parent is replaced.
    NoResend,
    /// A loop over `incidentpol` changes the variable but not the incident light.
    FixedIncidentPolarization,
    /// Numbers for the model are read up to the first character that does not fit: `0.5um`.
    NumericPrefix,
    /// `default` for a number of a nested object is read as a number: 0.
    NestedDefault,
    /// A changed interpolation or formula parameter of an index acts only at another wavelength.
    StaleInterpolation,
    /// Apertures are polygons, cut and shifted at the horizon, with rim points in mode 3.
    PolygonApertures,
}

impl Quirk {
    /// Every quirk, in the order of this file.
    pub const ALL: &'static [Self] = &[
        Self::LostNegativeEnd,
        Self::NoResend,
        Self::FixedIncidentPolarization,
        Self::NumericPrefix,
        Self::NestedDefault,
        Self::StaleInterpolation,
        Self::PolygonApertures,
    ];

    /// True if `mode` reproduces it.
    pub fn applies_in(self, mode: Mode) -> bool {
        mode == Mode::Compat
    }
}

/// Dialect of texts in `mode`.
pub fn dialect(mode: Mode) -> Dialect {
    match mode {
        Mode::Sound => Dialect::Sound,
        Mode::Compat => Dialect::Compat,
    }
}
