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
    /// Numbers that are not a spectrum.
    #[error(transparent)]
    Samples(#[from] GridError),
}

/// A spectrum: values at wavelengths.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// As if given in ascending order, the order of the values.
    grid: Grid,
    values: Vec<f64>,
}

/// The unit of the wavelengths in a file, recognized by their size.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum WavelengthUnit {
    /// Micrometres: the largest number is below 30.
    Micrometre,
    /// Nanometres.
    Nanometre,
    /// Ångström: the largest number is above 2000.
    Angstrom,
}

impl WavelengthUnit {
    fn of(largest: f64) -> Self {
        if largest < 30.0 {
            Self::Micrometre
        } else if largest > 2000.0 {
            Self::Angstrom
        } else {
            Self::Nanometre
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
    /// comment line; a first line without any number is a heading.
    ///
    /// # Errors
    ///
    /// If a line does not hold two numbers, or the numbers are not a spectrum.
    pub fn parse(text: &str) -> Result<(Self, WavelengthUnit), SpectrumError> {
        let (mut wavelengths, mut values) = (Vec::new(), Vec::new());
        let mut heading_allowed = true;
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
                Err(_) if heading_allowed && is_heading(line_text) => {}
                Err(error) => return Err(error),
            }
            heading_allowed = false;
        }
        let unit = WavelengthUnit::of(wavelengths.iter().copied().fold(0.0, f64::max));
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
        Resampler::for_grid(&self.grid, outside).fine(&self.values)
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
        Ok(Resampler::new(&self.grid, interpolation, outside)?.fine(&self.values))
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

fn is_heading(text: &str) -> bool {
    text.split([' ', '\t', ',', ';']).all(|piece| piece.parse::<f64>().is_err())
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
