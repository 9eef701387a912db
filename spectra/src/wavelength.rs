//! Wavelengths: the grid of a measured or computed spectrum, and the 1 nm grid of the sums.

use thiserror::Error;

/// Number of points of the 1 nm grid.
pub const FINE_COUNT: usize = 471;

/// First wavelength of the 1 nm grid, in nm. The last is 830 nm (CIE 015:2018, ISO/CIE 11664-3).
pub const FINE_FIRST_NM: f64 = 360.0;

/// A function of wavelength on the grid 360, 361, … 830 nm, on which every sum is done.
pub type Fine = [f64; FINE_COUNT];

/// The wavelengths of the 1 nm grid, ascending, in nm.
pub fn fine_wavelengths() -> impl DoubleEndedIterator<Item = f64> + ExactSizeIterator {
    (0..FINE_COUNT).map(|i| FINE_FIRST_NM + i as f64)
}

/// Errors of a list of wavelengths or of the values on it.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum GridError {
    /// Fewer wavelengths than the interpolation needs.
    #[error("{got} wavelengths, at least {needed} are needed")]
    TooFew {
        /// The number of wavelengths.
        got: usize,
        /// The required number.
        needed: usize,
    },
    /// A wavelength that is not a finite number above zero.
    #[error("wavelength {nm} at position {index} is not a finite number above zero")]
    NotAWavelength {
        /// Position in the list as given, from 0.
        index: usize,
        /// The offending number.
        nm: f64,
    },
    /// The same wavelength twice.
    #[error("wavelength {nm} nm occurs more than once")]
    Duplicate {
        /// The wavelength, in nm.
        nm: f64,
    },
    /// Values and wavelengths differ in number.
    #[error("{values} values for {wavelengths} wavelengths")]
    Length {
        /// Number of wavelengths.
        wavelengths: usize,
        /// Number of values.
        values: usize,
    },
    /// A value that is infinite or not a number.
    #[error("value at position {index} is not a finite number")]
    NotFinite {
        /// Position in the list as given, from 0.
        index: usize,
    },
    /// Sprague interpolation on unequal steps.
    #[error("sprague interpolation needs equal steps")]
    NotUniform,
    /// No interpolation, but a grid that is not 1 nm on whole nanometres.
    #[error("without interpolation the wavelengths must be whole nanometres, 1 nm apart")]
    NotOneNanometre,
}

/// The wavelengths of a spectrum: finite, positive, distinct, at least two.
///
/// They may be given in any order. The grid keeps them ascending and remembers the order, so that
/// values are accepted in the given order.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    nm: Vec<f64>,
    /// `order[k]` is the position of `nm[k]` in the list as given.
    order: Vec<usize>,
}

impl Grid {
    /// A grid from wavelengths in nm, in any order.
    ///
    /// # Errors
    ///
    /// If there are fewer than two, one is not finite and positive, or two are equal.
    pub fn new(wavelengths_nm: &[f64]) -> Result<Self, GridError> {
        for (index, &nm) in wavelengths_nm.iter().enumerate() {
            if !(nm.is_finite() && nm > 0.0) {
                return Err(GridError::NotAWavelength { index, nm });
            }
        }
        if wavelengths_nm.len() < 2 {
            return Err(GridError::TooFew { got: wavelengths_nm.len(), needed: 2 });
        }
        let mut order: Vec<usize> = (0..wavelengths_nm.len()).collect();
        order.sort_by(|&a, &b| wavelengths_nm[a].total_cmp(&wavelengths_nm[b]));
        let nm: Vec<f64> = order.iter().map(|&i| wavelengths_nm[i]).collect();
        match nm.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(GridError::Duplicate { nm: pair[0] }),
            None => Ok(Self { nm, order }),
        }
    }

    /// The wavelengths, ascending, in nm.
    pub fn nm(&self) -> &[f64] {
        &self.nm
    }

    /// Number of wavelengths, at least two.
    #[allow(clippy::len_without_is_empty, reason = "a grid is never empty")]
    pub fn len(&self) -> usize {
        self.nm.len()
    }

    /// The step in nm if all steps are equal to 1e-9 of the first.
    pub fn step_nm(&self) -> Option<f64> {
        let step = self.nm[1] - self.nm[0];
        let equal = |pair: &[f64]| (pair[1] - pair[0] - step).abs() <= 1e-9 * step;
        self.nm.windows(2).all(equal).then_some(step)
    }

    /// True if the wavelengths are whole nanometres, 1 nm apart.
    pub fn is_one_nanometre(&self) -> bool {
        self.nm[0].fract() == 0.0 && self.nm.windows(2).all(|pair| pair[1] - pair[0] == 1.0)
    }

    /// Brings values from the order of the wavelengths as given into ascending order.
    ///
    /// # Errors
    ///
    /// If the number of values is not that of the wavelengths, or a value is not finite.
    pub fn sort(&self, values: &[f64]) -> Result<Vec<f64>, GridError> {
        if values.len() != self.len() {
            return Err(GridError::Length { wavelengths: self.len(), values: values.len() });
        }
        match values.iter().position(|value| !value.is_finite()) {
            Some(index) => Err(GridError::NotFinite { index }),
            None => Ok(self.order.iter().map(|&i| values[i]).collect()),
        }
    }

    /// The same wavelengths, given in ascending order.
    pub(crate) fn ascending(&self) -> Self {
        Self { nm: self.nm.clone(), order: (0..self.len()).collect() }
    }

    /// Position in the list as given of the `k`-th shortest wavelength.
    pub(crate) fn given_position(&self, k: usize) -> usize {
        self.order[k]
    }

    /// The grid of every other wavelength, from the shortest.
    ///
    /// `None` if fewer than two would be left. Values for it: every other one in ascending order.
    pub(crate) fn every_other(&self) -> Option<Self> {
        let nm: Vec<f64> = self.nm.iter().copied().step_by(2).collect();
        (nm.len() >= 2).then(|| Self { order: (0..nm.len()).collect(), nm })
    }
}

/// Nanometres from a wavelength in micrometres, rounded to 1e-6 nm.
///
/// The rounding removes errors of arithmetic (0.55·1000 = 550.0000…1), so that equal steps are
/// recognized as equal.
pub fn nm_from_um(um: f64) -> f64 {
    (um * 1e9).round() / 1e6
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_follow_their_wavelengths_into_ascending_order() {
        let grid = Grid::new(&[500.0, 400.0, 450.0]).unwrap();
        assert_eq!(grid.nm(), [400.0, 450.0, 500.0]);
        assert_eq!(grid.sort(&[1.0, 2.0, 3.0]).unwrap(), [2.0, 3.0, 1.0]);
        assert_eq!(grid.step_nm(), Some(50.0));
    }

    #[test]
    fn invalid_wavelengths_are_refused() {
        assert_eq!(Grid::new(&[500.0]), Err(GridError::TooFew { got: 1, needed: 2 }));
        assert_eq!(Grid::new(&[]), Err(GridError::TooFew { got: 0, needed: 2 }));
        assert_eq!(Grid::new(&[500.0, 400.0, 500.0]), Err(GridError::Duplicate { nm: 500.0 }));
        for bad in [f64::NAN, f64::INFINITY, 0.0, -500.0] {
            let refused = Grid::new(&[400.0, bad]).unwrap_err();
            assert!(matches!(refused, GridError::NotAWavelength { index: 1, .. }));
        }
    }

    #[test]
    fn refuses_values_that_do_not_fit() {
        let grid = Grid::new(&[400.0, 500.0]).unwrap();
        assert_eq!(grid.sort(&[1.0]), Err(GridError::Length { wavelengths: 2, values: 1 }));
        assert_eq!(grid.sort(&[1.0, f64::NAN]), Err(GridError::NotFinite { index: 1 }));
    }

    #[test]
    fn micrometres_become_round_nanometres() {
        for nm in 360..=830 {
            assert_eq!(nm_from_um(f64::from(nm) / 1000.0), f64::from(nm));
        }
        assert_eq!(nm_from_um(0.1 + 0.2), 300.0);
    }
}
