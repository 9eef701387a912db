//! The answer to a request.

use serde::Serialize;

use super::warnings::CaseWarning;

/// The answer to a request.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ColourResponse {
    /// One per case, in order.
    pub results: Vec<CaseResult>,
    /// Warnings of the cases, in order.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<CaseWarning>,
}

/// The colour of one case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CaseResult {
    /// The `id` of the case.
    pub id: String,
    /// XYZ of the Stokes components before the filters, where Stokes spectra were given.
    #[serde(rename = "XYZ_stokes", skip_serializing_if = "Option::is_none")]
    pub xyz_stokes: Option<[[f64; 3]; 4]>,
    /// XYZ behind the filters.
    #[serde(rename = "XYZ")]
    pub xyz: [f64; 3],
    /// XYZ of a perfect diffuser; null for emission.
    #[serde(rename = "white_XYZ")]
    pub white_xyz: Option<[f64; 3]>,
    /// Chromaticity; null for black.
    pub xy: Option<[f64; 2]>,
    /// L\*a\*b\* relative to the white; null for emission.
    #[serde(rename = "Lab")]
    pub lab: Option<[f64; 3]>,
    /// The requested RGB.
    pub rgb: Vec<RgbResult>,
}

/// RGB in one space by one adaptation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RgbResult {
    /// Name of the space.
    pub space: String,
    /// Name of the adaptation.
    pub adaptation: String,
    /// Linear, signed, unclipped.
    pub linear: [f64; 3],
    /// Encoded, signed, unclipped.
    pub encoded: [f64; 3],
    /// Encoded from linear values clipped to 0…1.
    pub encoded_clipped: [f64; 3],
    /// `encoded_clipped` as bytes.
    pub u8: [u8; 3],
    /// True if the linear values are in 0…1 within 1e-9.
    pub in_gamut: bool,
}

impl CaseResult {
    pub(super) fn is_finite(&self) -> bool {
        let numbers = self.xyz.iter().chain(self.lab.iter().flatten());
        let stokes = self.xyz_stokes.iter().flatten().flatten();
        let rgb = self.rgb.iter().flat_map(|rgb| rgb.linear.iter().chain(&rgb.encoded));
        numbers.chain(stokes).chain(rgb).all(|number| number.is_finite())
    }
}
