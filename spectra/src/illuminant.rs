//! Illuminants: the spectral power of the light, in any unit.
//!
//! | text | what | source |
//! | --- | --- | --- |
//! | `A`, `D50`, `D65` | CIE standard illuminants, 1 nm | ISO/CIE 11664-2:2022 |
//! | `C`, `D55`, `D75`, `ID50`, `ID65`, `HP1`–`HP5` | 5 nm, straight lines between | CIE 015:2018, CIE 184:2009 |
//! | `FL1`–`FL12`, `FL3.1`–`FL3.15`, `LED-B1` … `LED-V2` | lamps, 1 nm | CIE 015:2018 |
//! | `E` | equal energy | |
//! | `2856` | black body of that temperature in K | Planck |
//! | `D(5500)` | daylight of that correlated colour temperature in K | CIE 015:2018, 4.1.2 |
//!
//! Outside its table an illuminant is zero.

use thiserror::Error;

use crate::{
    Observer,
    data::{DAYLIGHT_COMPONENTS, ILLUMINANTS},
    interpolate::{Extrapolation, Interpolation, Resampler},
    name::{UnknownName, call, fold},
    wavelength::{FINE_COUNT, Fine, Grid, GridError, fine_wavelengths},
    xyz::Xyz,
};

/// Second radiation constant h c / k, in nm K (exact in the SI of 2019).
const SECOND_RADIATION_CONSTANT_NM_K: f64 = 6.626_070_15e-34 * 299_792_458.0 / 1.380_649e-23 * 1e9;

/// Temperatures for which the CIE defines daylight, in K.
const DAYLIGHT_K: std::ops::RangeInclusive<f64> = 4000.0..=25000.0;

/// Errors of making an illuminant.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum IlluminantError {
    /// Neither the name of a table nor a temperature.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// A temperature out of range.
    #[error("temperature {kelvin} K, expected {expected}")]
    Temperature {
        /// The temperature, in K.
        kelvin: f64,
        /// The accepted temperatures.
        expected: &'static str,
    },
    /// Samples that are not a spectrum.
    #[error(transparent)]
    Samples(#[from] GridError),
    /// A light without luminance.
    #[error("the light has no positive luminance between 360 and 830 nm")]
    Dark,
}

/// A light, on the 1 nm grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Illuminant {
    name: String,
    fine: Box<Fine>,
}

impl Illuminant {
    /// The illuminant described by a text: a CIE name, a number (black body, K) or `D(number)`.
    ///
    /// # Errors
    ///
    /// If it is none of these, or the temperature is out of range.
    pub fn parse(text: &str) -> Result<Self, IlluminantError> {
        if let Ok(kelvin) = text.trim().parse() {
            return Self::planck(kelvin);
        }
        match call(text) {
            Some((name, arguments)) if name == "d" && arguments.len() == 1 => {
                Self::daylight(arguments[0])
            }
            _ => Ok(Self::named(text)?),
        }
    }

    /// The CIE illuminant of that name. `F1` … `F12` are read as `FL1` … `FL12`.
    ///
    /// # Errors
    ///
    /// If there is none.
    pub fn named(name: &str) -> Result<Self, UnknownName> {
        let folded = match fold(name).strip_prefix('f') {
            Some(number) if number.starts_with(|c: char| c.is_ascii_digit()) => {
                format!("fl{number}")
            }
            _ => fold(name),
        };
        if folded == "e" {
            return Ok(Self { name: "E".to_owned(), fine: Box::new([100.0; FINE_COUNT]) });
        }
        for table in ILLUMINANTS {
            if let Some(index) = table.names().iter().position(|name| fold(name) == folded) {
                return Ok(Self { name: table.names()[index].clone(), fine: table.fine(index) });
            }
        }
        let mut accepted: Vec<String> = Self::names().map(str::to_owned).collect();
        accepted.extend(["kelvin", "D(kelvin)"].map(str::to_owned));
        Err(UnknownName::new("illuminant", name, accepted))
    }

    /// The names of the CIE illuminants, in the order in which users see them.
    pub fn names() -> impl Iterator<Item = &'static str> {
        let tabulated = ILLUMINANTS.iter().flat_map(|table| table.names());
        tabulated.map(String::as_str).chain(["E"])
    }

    /// A black body at a temperature in K, scaled to 100 at 560 nm.
    ///
    /// # Errors
    ///
    /// If the temperature is not from 500 K to 1e6 K; colder bodies emit hardly any visible light.
    pub fn planck(kelvin: f64) -> Result<Self, IlluminantError> {
        if !(500.0..=1e6).contains(&kelvin) {
            let expected = "from 500 to 1000000 K for a black body";
            return Err(IlluminantError::Temperature { kelvin, expected });
        }
        let radiance =
            |nm: f64| nm.powi(-5) / (SECOND_RADIATION_CONSTANT_NM_K / (nm * kelvin)).exp_m1();
        let scale = 100.0 / radiance(560.0);
        let mut fine = Box::new([0.0; FINE_COUNT]);
        for (value, nm) in fine.iter_mut().zip(fine_wavelengths()) {
            *value = scale * radiance(nm);
        }
        Ok(Self { name: kelvin.to_string(), fine })
    }

    /// Daylight of a correlated colour temperature in K.
    ///
    /// The factors M1, M2 are not rounded. The standard illuminants D50, D55, D65 and D75 are
    /// defined with rounded ones and at 1.4388/1.4380 of their nominal temperature: use their names.
    ///
    /// # Errors
    ///
    /// If the temperature is not from 4000 K to 25000 K.
    pub fn daylight(kelvin: f64) -> Result<Self, IlluminantError> {
        if !DAYLIGHT_K.contains(&kelvin) {
            let expected = "from 4000 to 25000 K for daylight";
            return Err(IlluminantError::Temperature { kelvin, expected });
        }
        let [m1, m2] = daylight_factors(kelvin);
        Ok(Self { name: format!("D({kelvin})"), fine: daylight_spectrum(m1, m2) })
    }

    /// A light given by samples: straight lines between them, zero outside.
    ///
    /// # Errors
    ///
    /// If the samples do not fit the wavelengths, or the light has no luminance.
    pub fn from_samples(name: &str, grid: &Grid, power: &[f64]) -> Result<Self, IlluminantError> {
        Self::interpolated(name, grid, power, Interpolation::Linear, Extrapolation::Zero)
    }

    /// A light given by samples, with a choice of interpolation.
    ///
    /// # Errors
    ///
    /// If the interpolation is not possible, the samples do not fit the wavelengths, or the
    /// light has no luminance.
    pub fn interpolated(
        name: &str,
        grid: &Grid,
        power: &[f64],
        interpolation: Interpolation,
        outside: Extrapolation,
    ) -> Result<Self, IlluminantError> {
        let fine =
            Resampler::new(grid, interpolation, outside)?.fine_not_negative(&grid.sort(power)?);
        let light = Self { name: name.to_owned(), fine };
        let is_visible = |observer| {
            let luminance = light.luminance(observer);
            luminance.is_finite() && luminance > 0.0
        };
        if Observer::ALL.into_iter().all(is_visible) {
            Ok(light)
        } else {
            Err(IlluminantError::Dark)
        }
    }

    /// The name: canonical for a CIE illuminant, the text of the number for a temperature.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The spectral power on the 1 nm grid.
    pub fn fine(&self) -> &Fine {
        &self.fine
    }

    /// XYZ of a perfect diffuser under this light; Y = 1.
    pub fn white(&self, observer: Observer) -> Xyz {
        let mut sum = [0.0; 3];
        for (s, c) in self.fine.iter().zip(observer.functions()) {
            for (sum, c) in sum.iter_mut().zip(c) {
                *sum += s * c;
            }
        }
        let luminance = self.luminance(observer);
        let [x, y, z] = sum.map(|sum| sum / luminance);
        Xyz::new(x, y, z)
    }

    /// Σ S ȳ, positive.
    pub(crate) fn luminance(&self, observer: Observer) -> f64 {
        self.fine.iter().zip(observer.functions()).map(|(s, c)| s * c[1]).sum()
    }
}

/// The factors M1, M2 of the daylight components, unrounded (CIE 015:2018, equations 4.7–4.12).
fn daylight_factors(kelvin: f64) -> [f64; 2] {
    let per = 1e3 / kelvin;
    let x = if kelvin <= 7000.0 {
        ((-4.6070 * per + 2.9678) * per + 0.09911) * per + 0.244063
    } else {
        ((-2.0064 * per + 1.9018) * per + 0.24748) * per + 0.237040
    };
    let y = (-3.000 * x + 2.870) * x - 0.275;
    let denominator = 0.0241 + 0.2562 * x - 0.7341 * y;
    [
        (-1.3515 - 1.7703 * x + 5.9114 * y) / denominator,
        (0.0300 - 31.4424 * x + 30.0717 * y) / denominator,
    ]
}

/// S0 + M1 S1 + M2 S2.
fn daylight_spectrum(m1: f64, m2: f64) -> Box<Fine> {
    let [mut spectrum, s1, s2] = [0, 1, 2].map(|column| DAYLIGHT_COMPONENTS.fine(column));
    for (value, (s1, s2)) in spectrum.iter_mut().zip(s1.iter().zip(s2.iter())) {
        *value += m1 * s1 + m2 * s2;
    }
    spectrum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_name_illuminants() {
        for (text, name) in [
            ("D65", "D65"),
            ("d65", "D65"),
            ("F11", "FL11"),
            ("fl3.15", "FL3.15"),
            ("led b3", "LED-B3"),
            ("E", "E"),
            ("2856", "2856"),
            ("D(5500)", "D(5500)"),
        ] {
            assert_eq!(Illuminant::parse(text).unwrap().name(), name);
        }
    }

    #[test]
    fn a_wrong_text_is_answered_with_what_is_accepted() {
        let Err(IlluminantError::Unknown(unknown)) = Illuminant::parse("D66") else {
            panic!("D66 is not an illuminant")
        };
        assert!(unknown.similar.contains(&"D65".to_owned()), "{:?}", unknown.similar);
        assert!(unknown.accepted.contains(&"D(kelvin)".to_owned()));
        for text in ["0", "-300", "NaN", "1e9", "D(3000)", "D(inf)", "D()", "", "D(5000,1)"] {
            assert!(Illuminant::parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn illuminant_a_is_a_black_body_of_its_own_constant() {
        // CIE 015:2018 equation 4.1 has c₂ = 1.435e7 nm K and T = 2848 K.
        let a = Illuminant::named("A").unwrap();
        let formula = |nm: f64| {
            100.0 * (560.0 / nm).powi(5) * f64::exp_m1(1.435e7 / (2848.0 * 560.0))
                / (1.435e7 / (2848.0 * nm)).exp_m1()
        };
        for (value, nm) in a.fine().iter().zip(fine_wavelengths()) {
            // The table has six digits.
            assert!((value / formula(nm) - 1.0).abs() < 4.8e-6, "{nm}");
        }
        let planck = Illuminant::planck(2848.0 * 1.438_776_877 / 1.435).unwrap();
        for (value, planck) in a.fine().iter().zip(planck.fine()) {
            assert!((value / planck - 1.0).abs() < 4.9e-6);
        }
    }

    #[test]
    fn the_standard_daylights_are_the_components_with_rounded_factors() {
        let round = |m: f64| (m * 1000.0).round() / 1000.0;
        for (name, nominal, tolerance) in [
            ("D50", 5000.0, 5.1e-4),
            ("D55", 5500.0, 5.1e-4),
            ("D65", 6500.0, 8.5e-4),
            ("D75", 7500.0, 5.1e-4),
        ] {
            let table = Illuminant::named(name).unwrap();
            let [m1, m2] = daylight_factors(nominal * 1.4388 / 1.4380).map(round);
            let formula = daylight_spectrum(m1, m2);
            // Every 5 nm to 780 nm: the rest is interpolated, and not tabulated for D55 and D75. The
            // tables have three decimals.
            for i in (0..=420).step_by(5) {
                let (table, formula) = (table.fine()[i], formula[i]);
                assert!((table - formula).abs() < tolerance, "{name} {i} {table} {formula}");
            }
        }
    }

    #[test]
    fn a_light_without_luminance_is_refused() {
        let grid = Grid::new(&[300.0, 350.0]).unwrap();
        assert_eq!(Illuminant::from_samples("uv", &grid, &[1.0, 1.0]), Err(IlluminantError::Dark));
        let grid = Grid::new(&[400.0, 700.0]).unwrap();
        for power in [[0.0, 0.0], [-1.0, -1.0]] {
            assert_eq!(Illuminant::from_samples("x", &grid, &power), Err(IlluminantError::Dark));
        }
    }
}
