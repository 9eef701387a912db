//! XYZ → CIE 1976 L\*u\*v\*.
//!
//! u\* = 13 L\* (u′ − u′ₙ), v\* = 13 L\* (v′ − v′ₙ), with u′ = 4X/(X+15Y+3Z), v′ = 9Y/(X+15Y+3Z).
//!
//! ISO/CIE 11664-5:2016.

use palette::white_point::Any;

use crate::{lab::lightness, xyz::Xyz};

/// CIE 1976 L\*u\*v\*; the white is not part of the value.
pub type Luv = palette::Luv<Any, f64>;

/// L\*u\*v\* of XYZ relative to a white. Black has u\* = v\* = 0.
pub fn from_xyz(xyz: Xyz, white: Xyz) -> Luv {
    let l = lightness(xyz.y / white.y);
    match (chromaticity(xyz), chromaticity(white)) {
        (Some([u, v]), Some([u_white, v_white])) => {
            Luv::new(l, 13.0 * l * (u - u_white), 13.0 * l * (v - v_white))
        }
        _ => Luv::new(l, 0.0, 0.0),
    }
}

/// (u′, v′); `None` where the denominator is zero.
pub fn chromaticity(xyz: Xyz) -> Option<[f64; 2]> {
    let denominator = xyz.x + 15.0 * xyz.y + 3.0 * xyz.z;
    (denominator != 0.0).then(|| [4.0 * xyz.x / denominator, 9.0 * xyz.y / denominator])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_known_colour_has_its_coordinates() {
        let white = crate::xyz::from_chromaticity([0.3127, 0.3290]);
        let luv = from_xyz(Xyz::new(0.25, 0.40, 0.10), white);
        // Computed with colour-science 0.4.7, ten decimals.
        for (ours, theirs) in
            [(luv.l, 69.4695307685), (luv.u, -40.7825925205), (luv.v, 73.4208349769)]
        {
            assert!((ours - theirs).abs() < 1e-10, "{ours} {theirs}");
        }
    }

    #[test]
    fn black_has_no_chroma() {
        let black = from_xyz(Xyz::new(0.0, 0.0, 0.0), Xyz::new(0.95, 1.0, 1.09));
        assert_eq!((black.u, black.v), (0.0, 0.0));
    }
}
