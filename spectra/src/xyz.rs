//! Spectrum → XYZ, and chromaticity.
//!
//! For a reflectance R under an illuminant S, on the 1 nm grid from 360 to 830 nm,
//!
//! XYZ = Σ R S c̄ / Σ S ȳ,
//!
//! so that a perfect diffuser has Y = 1; for a spectral radiance L in W/(m² sr nm)
//! XYZ = 683 Σ L c̄, with Y in cd/m². R may be signed (a Stokes component) and above one (a BRDF).
//!
//! CIE 015:2018, *Colorimetry*, 4th edition, section 7.

use palette::white_point::Any;

use crate::{Illuminant, Observer, wavelength::Fine};

/// Tristimulus values; the white they are relative to is known to whoever made them.
pub type Xyz = palette::Xyz<Any, f64>;

/// Luminous efficacy of 540 THz light, in lm/W (SI, 2019).
pub const LUMINOUS_EFFICACY: f64 = 683.0;

/// XYZ of the reflectance `reflectance` under an illuminant; a perfect diffuser has Y = 1.
pub fn reflected(reflectance: &Fine, illuminant: &Illuminant, observer: Observer) -> Xyz {
    let light = illuminant.fine();
    let functions = observer.functions();
    let mut sum = [0.0; 3];
    for ((r, s), c) in reflectance.iter().zip(light).zip(functions) {
        for (sum, c) in sum.iter_mut().zip(c) {
            *sum += r * s * c;
        }
    }
    let luminance = illuminant.luminance(observer);
    from_array(sum.map(|sum| sum / luminance))
}

/// XYZ of the spectral radiance `radiance` in W/(m² sr nm); Y is in cd/m².
pub fn emitted(radiance: &Fine, observer: Observer) -> Xyz {
    let mut sum = [0.0; 3];
    for (l, c) in radiance.iter().zip(observer.functions()) {
        for (sum, c) in sum.iter_mut().zip(c) {
            *sum += LUMINOUS_EFFICACY * l * c;
        }
    }
    from_array(sum)
}

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
    use crate::wavelength::FINE_COUNT;

    #[test]
    fn a_perfect_diffuser_has_the_white_of_the_light() {
        for observer in Observer::ALL {
            let light = Illuminant::named("FL11").unwrap();
            let xyz = reflected(&[1.0; FINE_COUNT], &light, observer);
            assert_eq!(xyz, light.white(observer));
            // 471 additions in the same order, so the quotient of equal numbers.
            assert_eq!(xyz.y, 1.0);
        }
    }

    #[test]
    fn one_watt_at_555_nm_is_683_lumen() {
        let mut line = [0.0; FINE_COUNT];
        line[555 - 360] = 1.0;
        assert_eq!(emitted(&line, Observer::Cie1931_2).y, 683.0);
    }

    #[test]
    fn black_has_no_chromaticity() {
        assert_eq!(chromaticity(Xyz::new(0.0, 0.0, 0.0)), None);
        let white = from_chromaticity([0.3127, 0.3290]);
        let [x, y] = chromaticity(white).unwrap();
        // Two divisions and their inverse: rounding.
        assert!((x - 0.3127).abs() < 1e-15 && (y - 0.3290).abs() < 1e-15);
    }
}
