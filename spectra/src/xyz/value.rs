//! Tristimulus values and chromaticities.

use palette::white_point::Any;

/// Tristimulus values; the white is not part of the value.
pub type Xyz = palette::Xyz<Any, f64>;

/// The chromaticity (x, y); `None` if X + Y + Z is zero.
pub fn chromaticity(xyz: Xyz) -> Option<[f64; 2]> {
    let sum = xyz.x + xyz.y + xyz.z;
    (sum != 0.0).then(|| [xyz.x / sum, xyz.y / sum])
}

/// The XYZ with Y = 1 of a chromaticity (x, y).
pub fn from_chromaticity([x, y]: [f64; 2]) -> Xyz {
    Xyz::new(x / y, 1.0, (1.0 - x - y) / y)
}

/// XYZ as an array.
pub(crate) fn to_array(xyz: Xyz) -> [f64; 3] {
    [xyz.x, xyz.y, xyz.z]
}

/// XYZ from an array.
pub(crate) fn from_array([x, y, z]: [f64; 3]) -> Xyz {
    Xyz::new(x, y, z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn black_has_no_chromaticity() {
        assert_eq!(chromaticity(Xyz::new(0.0, 0.0, 0.0)), None);
        let white = from_chromaticity([0.3127, 0.3290]);
        let [x, y] = chromaticity(white).unwrap();
        // Two divisions and their inverse: rounding.
        assert!((x - 0.3127).abs() < 1e-15 && (y - 0.3290).abs() < 1e-15);
    }
}
