//! XYZ ↔ CIE 1976 L\*a\*b\*.
//!
//! L\* = 116 f(Y/Yₙ) − 16, a\* = 500 (f(X/Xₙ) − f(Y/Yₙ)), b\* = 200 (f(Y/Yₙ) − f(Z/Zₙ)), with
//! f(t) = ∛t above (6/29)³ and 841/108 t + 4/29 below, also for negative t.
//!
//! ISO/CIE 11664-4:2019.

use palette::white_point::Any;

use crate::xyz::Xyz;

/// CIE 1976 L\*a\*b\*; the white is not part of the value.
pub type Lab = palette::Lab<Any, f64>;

const DELTA: f64 = 6.0 / 29.0;

/// L\*a\*b\* of XYZ relative to a white.
pub fn from_xyz(xyz: Xyz, white: Xyz) -> Lab {
    let [x, y, z] = [xyz.x / white.x, xyz.y / white.y, xyz.z / white.z].map(f);
    Lab::new(116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z))
}

/// XYZ of L\*a\*b\* relative to a white.
pub fn to_xyz(lab: Lab, white: Xyz) -> Xyz {
    let y = (lab.l + 16.0) / 116.0;
    let [x, y, z] = [y + lab.a / 500.0, y, y - lab.b / 200.0].map(f_inverse);
    Xyz::new(x * white.x, y * white.y, z * white.z)
}

fn f(t: f64) -> f64 {
    if t > DELTA.powi(3) { t.cbrt() } else { 841.0 / 108.0 * t + 4.0 / 29.0 }
}

fn f_inverse(f: f64) -> f64 {
    if f > DELTA { f.powi(3) } else { 108.0 / 841.0 * (f - 4.0 / 29.0) }
}

/// Lightness L\* of a relative luminance Y/Yₙ.
pub(crate) fn lightness(y: f64) -> f64 {
    116.0 * f(y) - 16.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_known_colour_has_its_coordinates_and_comes_back() {
        let white = crate::xyz::from_chromaticity([0.3127, 0.3290]);
        let xyz = Xyz::new(0.25, 0.40, 0.10);
        let lab = from_xyz(xyz, white);
        // Computed with colour-science 0.4.7, ten decimals.
        for (ours, theirs) in
            [(lab.l, 69.4695307685), (lab.a, -48.0423671081), (lab.b, 57.1322153233)]
        {
            assert!((ours - theirs).abs() < 1e-10, "{ours} {theirs}");
        }
        let back = to_xyz(lab, white);
        assert!((back.x - xyz.x).abs() < 1e-15 && (back.z - xyz.z).abs() < 1e-15);
    }

    #[test]
    fn negative_values_follow_the_straight_part() {
        let white = Xyz::new(1.0, 1.0, 1.0);
        let negative = Xyz::new(-0.1, -0.2, 0.3);
        let lab = from_xyz(negative, white);
        assert!((lab.l + 903.2962962962963 * 0.2).abs() < 1e-12);
        let back = to_xyz(lab, white);
        assert!((back.x + 0.1).abs() < 1e-15 && (back.y + 0.2).abs() < 1e-15);
    }
}
