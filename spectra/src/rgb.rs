//! RGB spaces: primaries, white, matrices derived from them, transfer curve.
//!
//! | space | white (x, y) | curve | source |
//! | --- | --- | --- | --- |
//! | `sRGB` | 0.3127, 0.3290 | sRGB | IEC 61966-2-1:1999 |
//! | `AdobeRGB1998` | 0.3127, 0.3290 | γ = 563/256 | Adobe RGB (1998), 2005-05 |
//! | `DisplayP3` | 0.3127, 0.3290 | sRGB | SMPTE EG 432-1 primaries |
//! | `DCI-P3` | 0.314, 0.351 | γ = 2.6 | SMPTE RP 431-2 |
//! | `Rec2020` | 0.3127, 0.3290 | BT.2020 | ITU-R BT.2020-2 |
//! | `ProPhotoRGB` | 0.3457, 0.3585 | ROMM | ISO 22028-2:2013 |
//! | `ACEScg` | 0.32168, 0.33767 | linear | AMPAS S-2014-004 (AP1) |
//! | `ACES2065-1` | 0.32168, 0.33767 | linear | SMPTE ST 2065-1 (AP0) |
//!
//! Printed matrices are rounded; ours follow from the chromaticities, so white is (1, 1, 1).

mod curve;
pub mod typed;

use thiserror::Error;

pub use curve::Curve;

use crate::{
    matrix::{Matrix3, apply, inverse, scale_columns},
    name::{UnknownName, call, fold, numbers},
    xyz::{Xyz, from_array, from_chromaticity, to_array},
};

/// Tolerance of the gamut limits 0 and 1, for rounding.
pub const GAMUT_TOLERANCE: f64 = 1e-9;

/// Errors of making an RGB space.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SpaceError {
    /// Neither a name nor a list of numbers.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// Numbers, but neither eight chromaticities nor nine matrix elements.
    #[error(
        "an rgb space takes 8 numbers (x, y of red, green, blue, white) or 9 (XYZ to RGB), got {got}"
    )]
    Count {
        /// The number of numbers.
        got: usize,
    },
    /// Primaries on a line, a white outside their triangle, a singular matrix.
    #[error("the {what} do not span an rgb space")]
    Degenerate {
        /// The invalid part.
        what: &'static str,
    },
}

/// An RGB space.
#[derive(Clone, Debug, PartialEq)]
pub struct RgbSpace {
    name: String,
    to_xyz: Matrix3,
    from_xyz: Matrix3,
    white: Xyz,
    curve: Curve,
}

/// Name, primaries, white and curve of a standard space.
type StandardSpace = (&'static str, [[f64; 2]; 3], [f64; 2], Curve);

const D65: [f64; 2] = [0.3127, 0.3290];
const ACES: [f64; 2] = [0.32168, 0.33767];

const SRGB: StandardSpace = ("sRGB", [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]], D65, Curve::Srgb);
const ADOBE: StandardSpace =
    ("AdobeRGB1998", [[0.64, 0.33], [0.21, 0.71], [0.15, 0.06]], D65, Curve::Gamma(563.0 / 256.0));
const DISPLAY_P3: StandardSpace =
    ("DisplayP3", [[0.680, 0.320], [0.265, 0.690], [0.150, 0.060]], D65, Curve::Srgb);
const DCI_P3: StandardSpace =
    ("DCI-P3", [[0.680, 0.320], [0.265, 0.690], [0.150, 0.060]], [0.314, 0.351], Curve::Gamma(2.6));
const REC2020: StandardSpace =
    ("Rec2020", [[0.708, 0.292], [0.170, 0.797], [0.131, 0.046]], D65, Curve::Rec2020);
const PROPHOTO: StandardSpace = (
    "ProPhotoRGB",
    [[0.7347, 0.2653], [0.1596, 0.8404], [0.0366, 0.0001]],
    [0.3457, 0.3585],
    Curve::ProPhoto,
);
const ACESCG: StandardSpace =
    ("ACEScg", [[0.713, 0.293], [0.165, 0.830], [0.128, 0.044]], ACES, Curve::Linear);
const ACES2065_1: StandardSpace =
    ("ACES2065-1", [[0.7347, 0.2653], [0.0, 1.0], [0.0001, -0.0770]], ACES, Curve::Linear);

/// The standard spaces, in the order in which users see them.
const STANDARD: [&StandardSpace; 8] =
    [&SRGB, &ADOBE, &DISPLAY_P3, &DCI_P3, &REC2020, &PROPHOTO, &ACESCG, &ACES2065_1];

/// Other names of standard spaces. Rec. 709 has the primaries and the white of sRGB; a table of
/// linear values is the same.
const ALIASES: [(&str, &str); 5] = [
    ("rec709", "sRGB"),
    ("bt709", "sRGB"),
    ("adobergb", "AdobeRGB1998"),
    ("bt2020", "Rec2020"),
    ("prophoto", "ProPhotoRGB"),
];

impl RgbSpace {
    /// sRGB.
    pub fn srgb() -> Self {
        Self::standard(&SRGB)
    }

    /// ITU-R BT.2020.
    pub fn rec2020() -> Self {
        Self::standard(&REC2020)
    }

    /// The names of the standard spaces, in the order in which users see them.
    pub fn names() -> impl Iterator<Item = &'static str> {
        STANDARD.iter().map(|standard| standard.0)
    }

    /// The standard space of that name; `Rec709`, `AdobeRGB`, `BT2020`, `ProPhoto` are understood.
    ///
    /// # Errors
    ///
    /// If there is none.
    pub fn named(name: &str) -> Result<Self, UnknownName> {
        let folded = fold(name);
        let alias = ALIASES.iter().find(|(alias, _)| *alias == folded);
        let canonical = alias.map_or(folded, |(_, name)| fold(name));
        match STANDARD.iter().find(|standard| fold(standard.0) == canonical) {
            Some(standard) => Ok(Self::standard(standard)),
            None => {
                let forms = ["primaries(rx,ry,gx,gy,bx,by,wx,wy)", "matrix(m11,…,m33)"];
                let accepted = Self::names().chain(forms).map(str::to_owned).collect();
                Err(UnknownName::new("rgb space", name, accepted))
            }
        }
    }

    /// The space described by a text: a name, `primaries(rx,ry,gx,gy,bx,by,wx,wy)`, or
    /// `matrix(m11,m12,…,m33)`, the matrix from XYZ to RGB row by row. The words `primaries` and
    /// `matrix` may be left out. A space given by numbers has no transfer curve.
    ///
    /// # Errors
    ///
    /// If it is none of these, or the numbers are not a space.
    pub fn parse(text: &str) -> Result<Self, SpaceError> {
        let bare = text.trim().trim_start_matches('[').trim_end_matches(']');
        let list = match call(text) {
            Some((name, list)) if name == "primaries" || name == "matrix" => list,
            Some(_) => return Ok(Self::named(text)?),
            None => match numbers(bare) {
                Some(list) if !list.is_empty() => list,
                _ => return Ok(Self::named(text)?),
            },
        };
        match list[..] {
            [rx, ry, gx, gy, bx, by, wx, wy] => {
                let primaries = [[rx, ry], [gx, gy], [bx, by]];
                Self::from_primaries(text.trim(), primaries, [wx, wy], Curve::Linear)
            }
            [a, b, c, d, e, f, g, h, i] => {
                Self::from_matrix(text.trim(), [[a, b, c], [d, e, f], [g, h, i]], Curve::Linear)
            }
            _ => Err(SpaceError::Count { got: list.len() }),
        }
    }

    /// A space from the chromaticities of its primaries and its white.
    ///
    /// # Errors
    ///
    /// If the primaries lie on a line, or the white is not inside their triangle.
    pub fn from_primaries(
        name: &str,
        primaries: [[f64; 2]; 3],
        white: [f64; 2],
        curve: Curve,
    ) -> Result<Self, SpaceError> {
        let degenerate = SpaceError::Degenerate { what: "primaries and the white" };
        let white = from_chromaticity(white);
        // Columns x, y, 1 − x − y: unlike Y = 1 they exist also for a primary with y = 0.
        let [r, g, b] = primaries.map(|[x, y]| [x, y, 1.0 - x - y]);
        let columns = [0, 1, 2].map(|i| [r[i], g[i], b[i]]);
        let amounts = inverse(&columns).map(|inverse| apply(&inverse, to_array(white)));
        let Some(amounts) = amounts.filter(|a| a.iter().all(|a| a.is_finite() && *a > 0.0)) else {
            return Err(degenerate);
        };
        let to_xyz = scale_columns(&columns, amounts);
        let from_xyz = inverse(&to_xyz).ok_or(degenerate)?;
        Ok(Self { name: name.to_owned(), to_xyz, from_xyz, white, curve })
    }

    /// A space from its matrix from XYZ to linear RGB. Its white is what the matrix takes to
    /// (1, 1, 1), scaled to Y = 1.
    ///
    /// # Errors
    ///
    /// If the matrix is singular, or nothing with a positive Y goes to (1, 1, 1).
    pub fn from_matrix(name: &str, from_xyz: Matrix3, curve: Curve) -> Result<Self, SpaceError> {
        let degenerate = SpaceError::Degenerate { what: "rows of the matrix" };
        let Some(to_xyz) = inverse(&from_xyz) else { return Err(degenerate) };
        let [x, y, z] = apply(&to_xyz, [1.0; 3]);
        let white = Xyz::new(x / y, 1.0, z / y);
        if !(y > 0.0 && white.x.is_finite() && white.z.is_finite()) {
            return Err(degenerate);
        }
        Ok(Self { name: name.to_owned(), to_xyz, from_xyz, white, curve })
    }

    fn standard(&(name, primaries, white, curve): &StandardSpace) -> Self {
        match Self::from_primaries(name, primaries, white, curve) {
            Ok(space) => space,
            Err(_) => unreachable!("a test makes every standard space"),
        }
    }

    /// The name, or the text that described the space.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The white, Y = 1.
    pub fn white(&self) -> Xyz {
        self.white
    }

    /// The matrix from XYZ to linear RGB.
    pub fn from_xyz_matrix(&self) -> &Matrix3 {
        &self.from_xyz
    }

    /// The matrix from linear RGB to XYZ.
    pub fn to_xyz_matrix(&self) -> &Matrix3 {
        &self.to_xyz
    }

    /// The transfer curve.
    pub fn curve(&self) -> Curve {
        self.curve
    }

    /// Linear RGB of XYZ relative to the white of the space: signed and unclipped.
    pub fn linear(&self, xyz: Xyz) -> [f64; 3] {
        apply(&self.from_xyz, to_array(xyz))
    }

    /// XYZ of linear RGB.
    pub fn xyz(&self, linear: [f64; 3]) -> Xyz {
        from_array(apply(&self.to_xyz, linear))
    }

    /// Encoded RGB of linear RGB, signed and unclipped.
    pub fn encode(&self, linear: [f64; 3]) -> [f64; 3] {
        linear.map(|v| self.curve.encode(v))
    }

    /// Encoded RGB of linear RGB clipped to 0…1, for previews.
    pub fn encode_clipped(&self, linear: [f64; 3]) -> [f64; 3] {
        linear.map(|v| self.curve.encode(v.clamp(0.0, 1.0)))
    }

    /// Bytes of linear RGB clipped to 0…1: ⌊255 v + ½⌋ of the encoded value.
    pub fn encode_u8(&self, linear: [f64; 3]) -> [u8; 3] {
        // The value is clipped to the range of u8; the cast truncates.
        self.encode_clipped(linear).map(|v| (255.0 * v + 0.5) as u8)
    }
}

/// True if linear RGB lies in 0…1 within [`GAMUT_TOLERANCE`].
pub fn in_gamut(linear: [f64; 3]) -> bool {
    linear.iter().all(|v| (-GAMUT_TOLERANCE..=1.0 + GAMUT_TOLERANCE).contains(v))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_standard_space_takes_its_white_to_one() {
        for name in RgbSpace::names() {
            let space = RgbSpace::named(name).unwrap();
            for v in space.linear(space.white()) {
                // Products up to 2.5 of rounded matrix elements.
                assert!((v - 1.0).abs() < 2e-15, "{name} {v}");
            }
        }
    }

    #[test]
    fn the_derived_srgb_matrix_rounds_to_the_printed_one() {
        // IEC 61966-2-1:1999, equation 7.
        let printed =
            [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];
        let derived = RgbSpace::srgb().to_xyz_matrix().map(|r| r.map(|v| (v * 1e4).round() / 1e4));
        assert_eq!(derived, printed);
    }

    #[test]
    fn the_printed_inverse_is_up_to_four_units_off() {
        // IEC 61966-2-1:1999, equation 8, computed there from rounded numbers.
        let printed =
            [[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]];
        let derived = RgbSpace::srgb().from_xyz_matrix().map(|row| row);
        let worst = (0..9).map(|k| (derived[k / 3][k % 3] - printed[k / 3][k % 3]).abs());
        let worst = worst.fold(0.0, f64::max);
        assert!((3.0e-4..4.5e-4).contains(&worst), "{worst}");
    }

    #[test]
    fn texts_name_spaces() {
        assert_eq!(RgbSpace::parse("srgb").unwrap(), RgbSpace::srgb());
        assert_eq!(RgbSpace::parse("rec709").unwrap(), RgbSpace::srgb());
        let text = "primaries(0.64,0.33, 0.3,0.6, 0.15,0.06, 0.3127,0.329)";
        let custom = RgbSpace::parse(text).unwrap();
        assert_eq!(custom.from_xyz_matrix(), RgbSpace::srgb().from_xyz_matrix());
        assert_eq!(custom.curve(), Curve::Linear);
        let identity = RgbSpace::parse("1 0 0  0 1 0  0 0 1").unwrap();
        assert_eq!(identity.linear(Xyz::new(0.1, 0.2, 0.3)), [0.1, 0.2, 0.3]);
        assert_eq!(identity.white(), Xyz::new(1.0, 1.0, 1.0));
    }

    #[test]
    fn wrong_spaces_are_refused() {
        let Err(SpaceError::Unknown(unknown)) = RgbSpace::parse("sRBG") else {
            panic!("sRBG is not a space")
        };
        assert!(unknown.similar.contains(&"sRGB".to_owned()));
        assert_eq!(RgbSpace::parse("1,2,3"), Err(SpaceError::Count { got: 3 }));
        for bad in [
            "1 2 3 2 4 6 0 0 1",
            "primaries(0.1,0.1,0.2,0.2,0.3,0.3,0.3127,0.329)",
            "primaries(0.64,0.33,0.3,0.6,0.15,0.06,0.9,0.05)",
            "primaries(0.64,0.33,0.3,0.6,0.15,0.06,0.3,0)",
            "primaries(x)",
            "",
        ] {
            assert!(RgbSpace::parse(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn bytes_are_rounded_and_clipped() {
        let srgb = RgbSpace::srgb();
        assert_eq!(srgb.encode_u8([-0.5, 0.5, 7.0]), [0, 188, 255]);
        assert_eq!(srgb.encode_u8([f64::NAN; 3]), [0; 3]);
        assert!(in_gamut([-1e-10, 0.5, 1.0 + 1e-10]) && !in_gamut([0.0, 0.5, 1.0 + 1e-8]));
    }
}
