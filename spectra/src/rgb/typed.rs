//! The standard spaces as types for `palette`, on exact matrices and signed curves.
//!
//! `palette`'s own spaces have matrices of seven digits and curves that are not a number or run off
//! below zero; these are the ones to use with its types:
//!
//! ```
//! use palette::{FromColor, Xyz, convert::FromColorUnclamped, rgb::Rgb};
//! use spectra::rgb::typed::{Rec2020, WhiteD65};
//!
//! let xyz: Xyz<WhiteD65, f64> = Xyz::new(0.3, 0.4, 0.2);
//! // Unclamped: `from_color` would clip what is out of gamut.
//! let rgb = Rgb::<Rec2020, f64>::from_color_unclamped(xyz);
//! # assert!(rgb.green > rgb.red);
//! # let _ = Rgb::<Rec2020, f64>::from_color(xyz);
//! ```

use std::sync::LazyLock;

use palette::{
    Mat3, Yxy,
    encoding::{FromLinear, IntoLinear},
    rgb::{Primaries, RgbSpace as PaletteSpace, RgbStandard},
    white_point::{Any, WhitePoint},
};

use super::{
    ACES2065_1, ACESCG, ADOBE, DCI_P3, DISPLAY_P3, PROPHOTO, REC2020, RgbSpace, SRGB, StandardSpace,
};
use crate::xyz::{Xyz, from_chromaticity};

macro_rules! whites {
    ($($(#[$doc:meta])* $white:ident = $standard:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Eq, PartialEq)]
        pub struct $white;

        impl WhitePoint<f64> for $white {
            fn get_xyz() -> Xyz {
                from_chromaticity($standard.2)
            }
        }
    )*};
}

whites! {
    /// The white (0.3127, 0.3290) of sRGB, Adobe RGB, Display P3 and BT.2020.
    WhiteD65 = SRGB;
    /// The white (0.314, 0.351) of DCI-P3.
    WhiteDci = DCI_P3;
    /// The white (0.3457, 0.3585) of ProPhoto RGB.
    WhiteD50 = PROPHOTO;
    /// The white (0.32168, 0.33767) of ACES.
    WhiteAces = ACESCG;
}

macro_rules! spaces {
    ($($(#[$doc:meta])* $space:ident = $standard:ident, $white:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Eq, PartialEq)]
        pub struct $space;

        impl $space {
            fn exact() -> &'static RgbSpace {
                static SPACE: LazyLock<RgbSpace> =
                    LazyLock::new(|| RgbSpace::standard(&$standard));
                &SPACE
            }
        }

        impl Primaries<f64> for $space {
            fn red() -> Yxy<Any, f64> {
                primary(&$standard, Self::exact(), 0)
            }
            fn green() -> Yxy<Any, f64> {
                primary(&$standard, Self::exact(), 1)
            }
            fn blue() -> Yxy<Any, f64> {
                primary(&$standard, Self::exact(), 2)
            }
        }

        impl PaletteSpace for $space {
            type Primaries = Self;
            type WhitePoint = $white;

            fn rgb_to_xyz_matrix() -> Option<Mat3<f64>> {
                Some(flat(Self::exact().to_xyz_matrix()))
            }
            fn xyz_to_rgb_matrix() -> Option<Mat3<f64>> {
                Some(flat(Self::exact().from_xyz_matrix()))
            }
        }

        impl RgbStandard for $space {
            type Space = Self;
            type TransferFn = Self;
        }

        impl FromLinear<f64, f64> for $space {
            fn from_linear(linear: f64) -> f64 {
                $standard.3.encode(linear)
            }
        }

        impl IntoLinear<f64, f64> for $space {
            fn into_linear(encoded: f64) -> f64 {
                $standard.3.decode(encoded)
            }
        }
    )*};
}

spaces! {
    /// sRGB.
    Srgb = SRGB, WhiteD65;
    /// Adobe RGB (1998).
    AdobeRgb1998 = ADOBE, WhiteD65;
    /// Display P3.
    DisplayP3 = DISPLAY_P3, WhiteD65;
    /// DCI-P3.
    DciP3 = DCI_P3, WhiteDci;
    /// ITU-R BT.2020.
    Rec2020 = REC2020, WhiteD65;
    /// ProPhoto (ROMM) RGB.
    ProPhotoRgb = PROPHOTO, WhiteD50;
    /// ACEScg (AP1).
    AcesCg = ACESCG, WhiteAces;
    /// ACES2065-1 (AP0).
    Aces2065_1 = ACES2065_1, WhiteAces;
}

/// Chromaticity of a primary, with its part of the luminance of white.
fn primary(standard: &StandardSpace, space: &RgbSpace, index: usize) -> Yxy<Any, f64> {
    let [x, y] = standard.1[index];
    Yxy::new(x, y, space.to_xyz_matrix()[1][index])
}

fn flat([a, b, c]: &[[f64; 3]; 3]) -> Mat3<f64> {
    [a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]]
}

#[cfg(test)]
mod tests {
    use palette::{convert::FromColorUnclamped, rgb::Rgb};

    use super::*;

    fn agrees<S, W>(name: &str)
    where
        S: RgbStandard + FromLinear<f64, f64> + IntoLinear<f64, f64>,
        W: WhitePoint<f64>,
        Rgb<S, f64>: FromColorUnclamped<palette::Xyz<W, f64>>,
        palette::Xyz<W, f64>: FromColorUnclamped<Rgb<S, f64>>,
    {
        let space = RgbSpace::named(name).unwrap();
        for xyz in [[0.3, 0.4, 0.2], [0.05, 0.3, 0.9], [-0.1, 0.2, 0.1]] {
            let typed = Rgb::<S, f64>::from_color_unclamped(palette::Xyz::<W, f64>::from(xyz));
            let ours = space.encode(space.linear(Xyz::from(xyz)));
            // The same numbers, perhaps added in another order; the curves steepen near zero.
            for (a, b) in [typed.red, typed.green, typed.blue].into_iter().zip(ours) {
                assert!((a - b).abs() < 1e-14, "{name} {a} {b}");
            }
            let back = palette::Xyz::<W, f64>::from_color_unclamped(typed);
            // As above, there and back.
            assert!((back.x - xyz[0]).abs() < 1e-14 && (back.z - xyz[2]).abs() < 1e-14);
        }
    }

    #[test]
    fn the_typed_spaces_are_the_named_ones() {
        agrees::<Srgb, WhiteD65>("sRGB");
        agrees::<AdobeRgb1998, WhiteD65>("AdobeRGB1998");
        agrees::<DisplayP3, WhiteD65>("DisplayP3");
        agrees::<DciP3, WhiteDci>("DCI-P3");
        agrees::<Rec2020, WhiteD65>("Rec2020");
        agrees::<ProPhotoRgb, WhiteD50>("ProPhotoRGB");
        agrees::<AcesCg, WhiteAces>("ACEScg");
        agrees::<Aces2065_1, WhiteAces>("ACES2065-1");
    }
}
