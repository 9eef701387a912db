//! Chromatic adaptation: from the white of the light to the white of an RGB space.
//!
//! T⁻¹ diag(T w_dst / T w_src) T with complete adaptation (D = 1), both whites at Y = 1.
//!
//! | name | T | source |
//! | --- | --- | --- |
//! | `Bradford` | Lam's cone responses, linear | ICC.1:2022, annex E |
//! | `CAT02` | CIECAM02 | CIE 159:2004 |
//! | `CAT16` | CAM16 | C. Li et al., Color Res. Appl. 42, 703 (2017) |
//! | `VonKries` | Hunt–Pointer–Estevez cones, D65-normalized | R. W. G. Hunt, *The Reproduction of Colour*, 6th ed. (2004) |

use thiserror::Error;

use crate::{
    matrix::{IDENTITY, Matrix3, apply, inverse, multiply, scale_columns},
    name::{NamedValue, UnknownName},
    xyz::{Xyz, to_array},
};

/// The adaptation is not defined for a white.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{adaptation} adaptation has no positive cone responses for the white {white:?}")]
pub struct AdaptationError {
    /// The adaptation.
    pub adaptation: &'static str,
    /// The XYZ of the white.
    pub white: [f64; 3],
}

/// A chromatic adaptation transform.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Adaptation {
    /// None: XYZ are not adapted.
    None,
    /// Linear Bradford.
    #[default]
    Bradford,
    /// CIECAM02.
    Cat02,
    /// CAM16.
    Cat16,
    /// Von Kries on Hunt–Pointer–Estevez cones.
    VonKries,
}

impl Adaptation {
    const NAMES: [NamedValue<Self>; 5] = [
        NamedValue("none", Self::None),
        NamedValue("Bradford", Self::Bradford),
        NamedValue("CAT02", Self::Cat02),
        NamedValue("CAT16", Self::Cat16),
        NamedValue("VonKries", Self::VonKries),
    ];

    /// The adaptation called `none`, `Bradford`, `CAT02`, `CAT16` or `VonKries`.
    ///
    /// # Errors
    ///
    /// If it is none of these.
    pub fn parse(text: &str) -> Result<Self, UnknownName> {
        NamedValue::find("adaptation", text, &Self::NAMES)
    }

    /// The name that [`parse`](Self::parse) reads.
    pub fn name(self) -> &'static str {
        NamedValue::name_of(&Self::NAMES, self)
    }

    /// The matrix from XYZ to cone responses.
    pub fn cones(self) -> Matrix3 {
        match self {
            Self::None => IDENTITY,
            Self::Bradford => {
                [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]
            }
            Self::Cat02 => {
                [[0.7328, 0.4296, -0.1624], [-0.7036, 1.6975, 0.0061], [0.0030, 0.0136, 0.9834]]
            }
            Self::Cat16 => [
                [0.401288, 0.650173, -0.051461],
                [-0.250268, 1.204414, 0.045854],
                [-0.002079, 0.048952, 0.953127],
            ],
            Self::VonKries => {
                [[0.40024, 0.70760, -0.08081], [-0.22630, 1.16532, 0.04570], [0.0, 0.0, 0.91822]]
            }
        }
    }

    /// The matrix that adapts XYZ from white `from` to white `to`.
    ///
    /// # Errors
    ///
    /// If a white has a cone response that is not positive: no real light has.
    pub fn matrix(self, from: Xyz, to: Xyz) -> Result<Matrix3, AdaptationError> {
        if self == Self::None {
            return Ok(IDENTITY);
        }
        let cones = self.cones();
        let [source, target] = [from, to].map(|white| apply(&cones, to_array(white)));
        for (response, white) in [(source, from), (target, to)] {
            if !response.iter().all(|r| r.is_finite() && *r > 0.0) {
                return Err(AdaptationError { adaptation: self.name(), white: to_array(white) });
            }
        }
        let ratio = [0, 1, 2].map(|i| target[i] / source[i]);
        // The four matrices are constants with a determinant of about one.
        let back = inverse(&cones).unwrap_or(IDENTITY);
        Ok(multiply(&scale_columns(&back, ratio), &cones))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Adaptation; 4] =
        [Adaptation::Bradford, Adaptation::Cat02, Adaptation::Cat16, Adaptation::VonKries];

    #[test]
    fn white_goes_to_white_and_back() {
        let (a, d65) = (Xyz::new(1.0985, 1.0, 0.3558), Xyz::new(0.9505, 1.0, 1.0888));
        for adaptation in ALL {
            let there = adaptation.matrix(a, d65).unwrap();
            let back = adaptation.matrix(d65, a).unwrap();
            let round = multiply(&back, &there);
            for i in 0..3 {
                // A product of matrices of order one: a few roundings.
                assert!((apply(&there, to_array(a))[i] - to_array(d65)[i]).abs() < 1e-15);
                for j in 0..3 {
                    assert!((round[i][j] - IDENTITY[i][j]).abs() < 2e-15);
                }
            }
        }
    }

    #[test]
    fn a_white_that_no_light_has_is_refused() {
        let d65 = Xyz::new(0.9505, 1.0, 1.0888);
        for white in
            [Xyz::new(0.0, 0.0, 0.0), Xyz::new(1.0, 1.0, -1.0), Xyz::new(f64::NAN, 1.0, 1.0)]
        {
            for adaptation in ALL {
                assert!(adaptation.matrix(white, d65).is_err());
                assert!(adaptation.matrix(d65, white).is_err());
            }
        }
    }
}
