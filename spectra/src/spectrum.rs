//! A sampled function of wavelength, from numbers or from a text file.

use thiserror::Error;

use crate::{
    Illuminant, IlluminantError, Observer,
    interpolate::{Extrapolation, Interpolation, Resampler},
    wavelength::{Fine, Grid, GridError},
    xyz::{self, Xyz},
};

/// Errors of reading a spectrum.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SpectrumError {
    /// A line that does not hold two numbers.
    #[error("line {line}: expected a wavelength and a value, got `{text}`")]
    NotTwoNumbers {
        /// Line number, from 1.
        line: usize,
        /// The line.
        text: String,
    },
    /// A number with a comma for its decimal point.
    #[error("line {line}: decimal comma in `{text}`; write a decimal point")]
    DecimalComma {
        /// Line number, from 1.
        line: usize,
        /// The line.
        text: String,
    },
    /// Wavelengths that are not visible in any unit, and no heading that names the unit.
    #[error(
        "the unit of the wavelengths {first} to {last} is not certain; name it in a heading, such as \
         `nm value`"
    )]
    Unit {
        /// The shortest wavelength.
        first: f64,
        /// The longest wavelength.
        last: f64,
    },
    /// Numbers that are not a spectrum.
    #[error(transparent)]
    Samples(#[from] GridError),
}

/// The range of the sums for colours, nm.
pub(crate) const VISIBLE_NM: [f64; 2] = [360.0, 830.0];

/// The longest wavelength that counts as Å without a heading.
const LONGEST_ANGSTROM: f64 = 12_000.0;

/// A spectrum: values at wavelengths.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// As if given in ascending order, the order of the values.
    grid: Grid,
    values: Vec<f64>,
}

/// The unit of the wavelengths in a file: from its heading, or the one in which most of the range is
/// visible.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum WavelengthUnit {
    /// Micrometres.
    Micrometre,
    /// Nanometres.
    Nanometre,
    /// Ångström.
    Angstrom,
}

impl WavelengthUnit {
    const ALL: [Self; 3] = [Self::Nanometre, Self::Micrometre, Self::Angstrom];

    /// The unit that a heading names, if it names one only.
    fn of_heading(heading: &str) -> Option<Self> {
        let words = heading.split(|c: char| !c.is_alphabetic()).map(str::to_lowercase);
        let mut units = words.filter_map(|word| match word.as_str() {
            "nm" | "nanometer" | "nanometers" | "nanometre" | "nanometres" => Some(Self::Nanometre),
            "um" | "µm" | "μm" | "micron" | "microns" | "micrometer" | "micrometers"
            | "micrometre" | "micrometres" => Some(Self::Micrometre),
            "å" | "angstrom" | "angstroms" | "ångström" | "ångstrom" => Some(Self::Angstrom),
            _ => None,
        });
        let first = units.next()?;
        units.all(|unit| unit == first).then_some(first)
    }

    /// The unit in which the longest part of the range is visible, if any is. Ångström beyond
    /// [`LONGEST_ANGSTROM`] may be nanometres of the infrared, so the heading must tell.
    pub(crate) fn of_range([first, last]: [f64; 2]) -> Option<Self> {
        let visible = |unit: &Self| {
            let [low, high] = [first, last].map(|w| unit.to_nm(w));
            high.min(VISIBLE_NM[1]) - low.max(VISIBLE_NM[0])
        };
        let best = Self::ALL.into_iter().max_by(|a, b| visible(a).total_cmp(&visible(b)))?;
        let is_certain = best != Self::Angstrom || last <= LONGEST_ANGSTROM;
        (visible(&best) >= 0.0 && is_certain).then_some(best)
    }

    /// Its symbol.
    pub fn name(self) -> &'static str {
        match self {
            Self::Micrometre => "um",
            Self::Nanometre => "nm",
            Self::Angstrom => "angstrom",
        }
    }

    fn to_nm(self, wavelength: f64) -> f64 {
        match self {
            Self::Micrometre => crate::wavelength::nm_from_um(wavelength),
            Self::Nanometre => wavelength,
            Self::Angstrom => wavelength / 10.0,
        }
    }
}

impl Spectrum {
    /// A spectrum of values at wavelengths in nm, in any order.
    ///
    /// # Errors
    ///
    /// If the wavelengths are not a grid or the values do not fit.
    pub fn new(wavelengths_nm: &[f64], values: &[f64]) -> Result<Self, GridError> {
        let grid = Grid::new(wavelengths_nm)?;
        Ok(Self { values: grid.sort(values)?, grid: grid.ascending() })
    }

    /// A spectrum from a text of two columns, and the unit its wavelengths were taken to be in.
    ///
    /// Columns are separated by blanks, tabs, commas or semicolons; `#`, `//` and `;` begin a
    /// comment line; lines before the first number whose first word is not a number are headings.
    /// A heading may name the unit: nm, µm or Å.
    ///
    /// # Errors
    ///
    /// If a line does not hold two numbers, the numbers are not a spectrum, or the unit of the
    /// wavelengths is not certain.
    pub fn parse(text: &str) -> Result<(Self, WavelengthUnit), SpectrumError> {
        let (mut wavelengths, mut values) = (Vec::new(), Vec::new());
        let mut heading = String::new();
        for (index, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
            let line_text = line.trim();
            let comment = ["#", "//", ";"].iter().any(|mark| line_text.starts_with(mark));
            if line_text.is_empty() || comment {
                continue;
            }
            match read_pair(index + 1, line_text) {
                Ok((wavelength, value)) => {
                    wavelengths.push(wavelength);
                    values.push(value);
                }
                Err(_) if wavelengths.is_empty() && is_heading(line_text) => heading += line_text,
                Err(error) => return Err(error),
            }
        }
        let first = wavelengths.iter().copied().fold(f64::INFINITY, f64::min);
        let last = wavelengths.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let named = WavelengthUnit::of_heading(&heading);
        let unit = match named.or_else(|| WavelengthUnit::of_range([first, last])) {
            Some(unit) => unit,
            // Too few or invalid wavelengths have an error of their own.
            None if !(first > 0.0 && first.is_finite() && last.is_finite()) => {
                WavelengthUnit::Nanometre
            }
            None => return Err(SpectrumError::Unit { first, last }),
        };
        let nm: Vec<f64> = wavelengths.iter().map(|w| unit.to_nm(*w)).collect();
        Ok((Self::new(&nm, &values)?, unit))
    }

    /// The wavelengths, in ascending order.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The values, in ascending order of wavelength.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The spectrum with each value replaced.
    pub fn map(&self, value: impl Fn(f64) -> f64) -> Self {
        let values = self.values.iter().map(|v| value(*v)).collect();
        Self { grid: self.grid.clone(), values }
    }

    /// The spectrum on the 1 nm grid, interpolated as its grid suggests.
    pub fn fine(&self, outside: Extrapolation) -> Box<Fine> {
        Resampler::for_grid(&self.grid, outside).fine_not_negative(&self.values)
    }

    /// The spectrum on the 1 nm grid, with a choice of interpolation.
    ///
    /// # Errors
    ///
    /// If the interpolation is not possible on the grid.
    pub fn fine_by(
        &self,
        interpolation: Interpolation,
        outside: Extrapolation,
    ) -> Result<Box<Fine>, GridError> {
        Ok(Resampler::new(&self.grid, interpolation, outside)?.fine_not_negative(&self.values))
    }

    /// XYZ of the spectrum taken as a reflectance: ends held, a perfect diffuser has Y = 1.
    pub fn xyz(&self, illuminant: &Illuminant, observer: Observer) -> Xyz {
        xyz::reflected(&self.fine(Extrapolation::Hold), illuminant, observer)
    }

    /// The light of this spectral power: straight lines between the samples, zero outside.
    ///
    /// # Errors
    ///
    /// If the light has no luminance.
    pub fn illuminant(&self, name: &str) -> Result<Illuminant, IlluminantError> {
        Illuminant::from_samples(name, &self.grid, &self.values)
    }
}

fn read_pair(line: usize, text: &str) -> Result<(f64, f64), SpectrumError> {
    let blocks: Vec<&str> = text
        .split([' ', '\t', ';'])
        .map(|block| block.trim_matches(','))
        .filter(|block| !block.is_empty())
        .collect();
    let numeric = |c: char| c.is_ascii_digit() || matches!(c, ',' | '.' | '-' | '+' | 'e' | 'E');
    if blocks.len() > 1 && blocks.iter().any(|b| b.contains(',') && b.chars().all(numeric)) {
        return Err(SpectrumError::DecimalComma { line, text: text.to_owned() });
    }
    let pieces: Vec<&str> = blocks.iter().flat_map(|block| block.split(',')).collect();
    match pieces[..] {
        [wavelength, value] => match (wavelength.parse(), value.parse()) {
            (Ok(wavelength), Ok(value)) => Ok((wavelength, value)),
            _ => Err(SpectrumError::NotTwoNumbers { line, text: text.to_owned() }),
        },
        _ => Err(SpectrumError::NotTwoNumbers { line, text: text.to_owned() }),
    }
}

/// True if the first word of a line is not a number: headings may have digits elsewhere.
fn is_heading(text: &str) -> bool {
    let first = text.split([' ', '\t', ',', ';']).find(|piece| !piece.is_empty());
    first.is_none_or(|first| first.trim_matches('"').parse::<f64>().is_err())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_read_with_any_separator() {
        for text in [
            "400 0.5\n500 0.6\n",
            "# a lamp\nnm,power\n400,0.5\n500,0.6",
            "400;0.5\n500;0.6",
            "// x\n; y\n400, 0.5\r\n500,\t0.6\r\n",
            "0.4 0.5\n0.5 0.6",
            "4000 0.5\n5000 0.6",
        ] {
            let (spectrum, _) = Spectrum::parse(text).unwrap();
            assert_eq!(spectrum, Spectrum::new(&[400.0, 500.0], &[0.5, 0.6]).unwrap(), "{text}");
        }
        assert_eq!(Spectrum::parse("0.4 1\n0.5 1").unwrap().1, WavelengthUnit::Micrometre);
    }

    #[test]
    fn the_unit_is_that_of_the_heading_or_of_the_visible_range() {
        let unit = |text: &str| Spectrum::parse(text).map(|(_, unit)| unit);
        use WavelengthUnit::{Angstrom, Micrometre, Nanometre};
        for (text, expected) in [
            ("300 1\n4000 2", Nanometre),
            ("Wavelength (nm) T at 300 K\n2500 1\n25000 2", Nanometre),
            ("lambda/um R\n2 1\n14 2", Micrometre),
            ("0.3 1\n40 2", Micrometre),
            ("3000 1\n11000 2", Angstrom),
            ("wavelength [Å], value\n1200 1\n3000 2", Angstrom),
            ("380 1\n780 2", Nanometre),
        ] {
            assert_eq!(unit(text), Ok(expected), "{text}");
        }
        for text in ["2 1\n14 2", "2500 1\n25000 2", "nm or um\n2 1\n14 2"] {
            let error = unit(text).unwrap_err();
            assert!(matches!(error, SpectrumError::Unit { .. }), "{text}: {error}");
        }
    }

    #[test]
    fn wrong_lines_are_named() {
        let error = |text| Spectrum::parse(text).unwrap_err();
        let comma = error("400 0,5\n500 0,6");
        assert!(matches!(comma, SpectrumError::DecimalComma { line: 1, .. }), "{comma}");
        let three = error("400 0.5\n500 0.6 0.7");
        assert!(matches!(three, SpectrumError::NotTwoNumbers { line: 2, .. }), "{three}");
        let word = error("400 0.5\nnm power");
        assert!(matches!(word, SpectrumError::NotTwoNumbers { line: 2, .. }), "{word}");
        assert!(matches!(error(""), SpectrumError::Samples(GridError::TooFew { .. })));
        let nan = error("400 nan\n500 1");
        assert_eq!(nan, SpectrumError::Samples(GridError::NotFinite { index: 0 }));
    }
}
