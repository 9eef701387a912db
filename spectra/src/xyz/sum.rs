//! The sums over the 1 nm grid.

use super::value::{Xyz, from_array};
use crate::{illuminant::Illuminant, observer::Observer, wavelength::Fine};

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
}
