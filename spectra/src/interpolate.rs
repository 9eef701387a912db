//! Interpolation of a spectrum to the 1 nm grid.
//!
//! CIE 167:2005 recommends Sprague's formula for equal steps. On unequal steps a cubic spline can
//! oscillate far beyond its samples, so straight lines are the default there: they are monotone
//! between samples. Spectra without negative samples are never negative between them: what Sprague's
//! formula or a cubic spline gives below zero is set to zero. Signed spectra, such as Stokes
//! components, are not changed.

mod cubic;
mod interval;
mod linear;
mod sprague;

pub use cubic::cubic_spline;
pub(crate) use linear::interpolate as straight_lines;

use crate::{
    name::{NamedValue, UnknownName},
    wavelength::{FINE_COUNT, Fine, Grid, GridError, fine_wavelengths},
};

/// The interpolation of a spectrum between its samples.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Interpolation {
    /// None: the samples are 1 nm apart on whole nanometres.
    None,
    /// Sprague's fifth-degree formula; equal steps, at least six samples.
    Sprague,
    /// Cubic spline, not-a-knot; at least four samples.
    Cubic,
    /// Straight lines.
    Linear,
}

impl Interpolation {
    const NAMES: [NamedValue<Self>; 4] = [
        NamedValue("none", Self::None),
        NamedValue("sprague", Self::Sprague),
        NamedValue("cubic", Self::Cubic),
        NamedValue("linear", Self::Linear),
    ];

    /// The default interpolation on `grid`: Sprague's formula for six or more equal steps, a cubic
    /// spline for four or five, straight lines otherwise.
    pub fn for_grid(grid: &Grid) -> Self {
        if grid.is_one_nanometre() {
            Self::None
        } else if grid.step_nm().is_none() || grid.len() < 4 {
            Self::Linear
        } else if grid.len() < 6 {
            Self::Cubic
        } else {
            Self::Sprague
        }
    }

    /// The interpolation called `none`, `sprague`, `cubic` or `linear`.
    ///
    /// # Errors
    ///
    /// If it is none of these.
    pub fn parse(text: &str) -> Result<Self, UnknownName> {
        NamedValue::find("interpolation", text, &Self::NAMES)
    }

    /// The name that [`parse`](Self::parse) reads.
    pub fn name(self) -> &'static str {
        NamedValue::name_of(&Self::NAMES, self)
    }

    /// Checks that this interpolation is possible on `grid`.
    ///
    /// # Errors
    ///
    /// If the grid has too few samples or the wrong steps.
    pub fn check(self, grid: &Grid) -> Result<(), GridError> {
        let needed = match self {
            Self::None | Self::Linear => 2,
            Self::Cubic => 4,
            Self::Sprague => 6,
        };
        if grid.len() < needed {
            Err(GridError::TooFew { got: grid.len(), needed })
        } else if self == Self::Sprague && grid.step_nm().is_none() {
            Err(GridError::NotUniform)
        } else if self == Self::None && !grid.is_one_nanometre() {
            Err(GridError::NotOneNanometre)
        } else {
            Ok(())
        }
    }
}

/// The values of a spectrum outside its samples.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Extrapolation {
    /// The value of the nearest sample (reflectances).
    Hold,
    /// Zero (emission).
    Zero,
}

impl Extrapolation {
    const NAMES: [NamedValue<Self>; 2] =
        [NamedValue("hold", Self::Hold), NamedValue("zero", Self::Zero)];

    /// The extrapolation called `hold` or `zero`.
    ///
    /// # Errors
    ///
    /// If it is neither.
    pub fn parse(text: &str) -> Result<Self, UnknownName> {
        NamedValue::find("extrapolation", text, &Self::NAMES)
    }

    /// The name that [`parse`](Self::parse) reads.
    pub fn name(self) -> &'static str {
        NamedValue::name_of(&Self::NAMES, self)
    }
}

/// A grid with an interpolation that is possible on it.
#[derive(Clone, Debug)]
pub(crate) struct Resampler<'a> {
    grid: &'a Grid,
    interpolation: Interpolation,
    outside: Extrapolation,
}

impl<'a> Resampler<'a> {
    /// # Errors
    ///
    /// If the interpolation is not possible on the grid.
    pub(crate) fn new(
        grid: &'a Grid,
        interpolation: Interpolation,
        outside: Extrapolation,
    ) -> Result<Self, GridError> {
        interpolation.check(grid)?;
        Ok(Self { grid, interpolation, outside })
    }

    /// The interpolation that the grid itself suggests, which is always possible.
    pub(crate) fn for_grid(grid: &'a Grid, outside: Extrapolation) -> Self {
        Self { grid, interpolation: Interpolation::for_grid(grid), outside }
    }

    /// Values in ascending order of wavelength, brought to the 1 nm grid.
    pub(crate) fn fine(&self, sorted: &[f64]) -> Box<Fine> {
        let nm = self.grid.nm();
        let (first, last) = (nm[0], nm[nm.len() - 1]);
        let at: Vec<f64> = fine_wavelengths().map(|at| at.clamp(first, last)).collect();
        let mut fine = self.evaluate(sorted, &at);
        if self.outside == Extrapolation::Zero {
            for (value, at) in fine.iter_mut().zip(fine_wavelengths()) {
                if at < first || at > last {
                    *value = 0.0;
                }
            }
        }
        fine
    }

    /// As [`Resampler::fine`], but never below zero if no sample is: Sprague's formula and the cubic
    /// spline may swing below a narrow peak. Not linear in the samples any more.
    pub(crate) fn fine_not_negative(&self, sorted: &[f64]) -> Box<Fine> {
        let mut fine = self.fine(sorted);
        if sorted.iter().all(|value| *value >= 0.0) {
            fine.iter_mut().for_each(|value| *value = value.max(0.0));
        }
        fine
    }

    fn evaluate(&self, sorted: &[f64], at: &[f64]) -> Box<Fine> {
        let nm = self.grid.nm();
        let mut fine = Box::new([0.0; FINE_COUNT]);
        match self.interpolation {
            // Every 1 nm wavelength is a sample; a straight line through it is exact.
            Interpolation::None | Interpolation::Linear => {
                linear::interpolate(nm, sorted, at, &mut fine[..]);
            }
            Interpolation::Sprague => sprague::interpolate(nm, sorted, at, &mut fine[..]),
            Interpolation::Cubic => cubic::interpolate(nm, sorted, at, &mut fine[..]),
        }
        fine
    }

    /// The columns of the interpolation matrix: the contribution of each sample to the grid.
    ///
    /// In ascending order of wavelength.
    pub(crate) fn columns(&self) -> impl Iterator<Item = Box<Fine>> {
        let mut unit = vec![0.0; self.grid.len()];
        (0..self.grid.len()).map(move |k| {
            unit[k] = 1.0;
            let column = self.fine(&unit);
            unit[k] = 0.0;
            column
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_chooses_the_interpolation() {
        let chosen = |nm: &[f64]| Interpolation::for_grid(&Grid::new(nm).unwrap());
        assert_eq!(chosen(&[400.0, 401.0, 402.0]), Interpolation::None);
        assert_eq!(chosen(&[400.0, 410.0, 420.0, 430.0, 440.0, 450.0]), Interpolation::Sprague);
        assert_eq!(chosen(&[400.0, 410.0, 420.0, 430.0, 440.0]), Interpolation::Cubic);
        assert_eq!(chosen(&[400.0, 411.0, 420.0, 430.0, 440.0, 450.0]), Interpolation::Linear);
        assert_eq!(chosen(&[400.0, 411.0, 420.0]), Interpolation::Linear);
    }

    #[test]
    fn every_interpolation_passes_through_its_samples() {
        let nm: Vec<f64> = (0..12).map(|i| 400.0 + 10.0 * f64::from(i)).collect();
        let values: Vec<f64> = nm.iter().map(|nm| (nm / 20.0).sin()).collect();
        let grid = Grid::new(&nm).unwrap();
        for interpolation in [Interpolation::Sprague, Interpolation::Cubic, Interpolation::Linear] {
            let resampler = Resampler::new(&grid, interpolation, Extrapolation::Hold).unwrap();
            let fine = resampler.fine(&values);
            for (i, value) in values.iter().enumerate() {
                // The last sample is the end of an interval: a sum that rounds.
                assert!((fine[40 + 10 * i] - value).abs() < 1e-14, "{interpolation:?} {i}");
            }
        }
    }

    #[test]
    fn a_narrow_line_is_nowhere_negative() {
        let nm: Vec<f64> = (0..20).map(|i| 400.0 + 10.0 * f64::from(i)).collect();
        let grid = Grid::new(&nm).unwrap();
        let mut line = vec![0.0; 20];
        line[9] = 1.0;
        for interpolation in [Interpolation::Sprague, Interpolation::Cubic] {
            let resampler = Resampler::new(&grid, interpolation, Extrapolation::Zero).unwrap();
            assert!(resampler.fine(&line).iter().any(|value| *value < 0.0));
            assert!(resampler.fine_not_negative(&line).iter().all(|value| *value >= 0.0));
            line[3] = -0.1;
            assert_eq!(resampler.fine_not_negative(&line), resampler.fine(&line));
            line[3] = 0.0;
        }
    }

    #[test]
    fn outside_is_held_or_zero() {
        let grid = Grid::new(&[500.0, 600.0]).unwrap();
        let held = Resampler::for_grid(&grid, Extrapolation::Hold).fine(&[1.0, 2.0]);
        assert_eq!((held[0], held[190], held[470]), (1.0, 1.5, 2.0));
        let zero = Resampler::for_grid(&grid, Extrapolation::Zero).fine(&[1.0, 2.0]);
        assert_eq!((zero[139], zero[140], zero[240], zero[241]), (0.0, 1.0, 2.0, 0.0));
    }

    #[test]
    fn refuses_an_impossible_interpolation() {
        let grid = Grid::new(&[400.0, 410.0, 425.0, 430.0, 440.0, 450.0]).unwrap();
        assert_eq!(Interpolation::Sprague.check(&grid), Err(GridError::NotUniform));
        assert_eq!(Interpolation::None.check(&grid), Err(GridError::NotOneNanometre));
        let short = Grid::new(&[400.0, 410.0, 420.0]).unwrap();
        assert_eq!(
            Interpolation::Cubic.check(&short),
            Err(GridError::TooFew { got: 3, needed: 4 })
        );
    }
}
