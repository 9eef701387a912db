//! Error estimate for the XYZ of a sampled spectrum.
//!
//! D is the change when every other sample is left out. The estimate max(D/16, |Sprague − spline|)
//! follows the true error within a factor of about 4, unless the samples are too coarse for the
//! structure; then D itself is large. Halve the step if the estimate or D exceeds its limit.

use crate::{
    Illuminant, Observer,
    interpolate::{Extrapolation, Interpolation, Resampler},
    wavelength::Grid,
    weights::{SpectralSensitivity, XyzWeights},
    xyz::{Xyz, to_array},
};

/// An estimate above this asks for a finer grid (XYZ with white Y = 1).
const ESTIMATE_LIMIT: f64 = 1e-4;

/// A change by thinning above this asks for a finer grid.
const THINNED_LIMIT: f64 = 1e-3;

/// The estimated error of the XYZ of a spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct XyzAccuracy {
    /// Estimated error, the worst of X, Y and Z.
    pub estimate: f64,
    /// D: the change when every other sample is left out.
    pub thinned: f64,
}

impl XyzAccuracy {
    /// True if the spectrum should be computed with half the step; for XYZ with white Y = 1.
    pub fn needs_finer_grid(&self) -> bool {
        self.estimate > ESTIMATE_LIMIT || self.thinned > THINNED_LIMIT
    }
}

/// The weights for estimates on one grid.
#[derive(Clone, Debug)]
pub struct AccuracyCheck {
    all: XyzWeights,
    thinned: XyzWeights,
    /// Only where the samples are interpolated by Sprague's formula.
    spline: Option<XyzWeights>,
}

impl AccuracyCheck {
    /// Prepares estimates for reflectances. `None` for fewer than three wavelengths.
    pub fn new(
        grid: &Grid,
        illuminant: &Illuminant,
        observer: Observer,
        outside: Extrapolation,
    ) -> Option<Self> {
        let sensitivity = SpectralSensitivity::relative(illuminant, observer);
        let half = grid.every_other()?;
        let half_weights =
            XyzWeights::fold(&half, &Resampler::for_grid(&half, outside), &sensitivity);
        let spline = (Interpolation::for_grid(grid) == Interpolation::Sprague)
            .then(|| Resampler::new(grid, Interpolation::Cubic, outside).ok())
            .flatten()
            .map(|resampler| XyzWeights::fold(grid, &resampler, &sensitivity));
        Some(Self {
            all: XyzWeights::fold(grid, &Resampler::for_grid(grid, outside), &sensitivity),
            thinned: half_weights.on_full_grid(grid),
            spline,
        })
    }

    /// Estimates the error for samples in the order in which the wavelengths were given.
    ///
    /// # Panics
    ///
    /// If there are not as many samples as wavelengths.
    pub fn estimate(&self, values: &[f64]) -> XyzAccuracy {
        let all = self.all.xyz(values);
        let thinned = distance(all, self.thinned.xyz(values));
        let spline = self.spline.as_ref().map_or(0.0, |spline| distance(all, spline.xyz(values)));
        XyzAccuracy { estimate: spline.max(thinned / 16.0), thinned }
    }
}

fn distance(a: Xyz, b: Xyz) -> f64 {
    to_array(a).into_iter().zip(to_array(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn film(thickness_nm: f64, nm: f64) -> f64 {
        // Two-beam interference of a film of index 2.5: structure of period λ²/(2 n d).
        0.3 + 0.2 * (2.0 * std::f64::consts::TAU * 2.5 * thickness_nm / nm).cos()
    }

    fn check(thickness_nm: f64, step_nm: f64) -> (XyzAccuracy, f64) {
        let light = Illuminant::named("D65").unwrap();
        let at = |step: f64| {
            let n = (390.0 / step) as usize + 1;
            let nm: Vec<f64> = (0..n).map(|i| 360.0 + step * i as f64).collect();
            let values: Vec<f64> = nm.iter().map(|nm| film(thickness_nm, *nm)).collect();
            (Grid::new(&nm).unwrap(), values)
        };
        let (grid, values) = at(step_nm);
        let check =
            AccuracyCheck::new(&grid, &light, Observer::Cie1931_2, Extrapolation::Hold).unwrap();
        let (fine_grid, fine_values) = at(1.0);
        let xyz = |grid: &Grid, values: &[f64]| {
            XyzWeights::new(grid, &light, Observer::Cie1931_2, Extrapolation::Hold).xyz(values)
        };
        let truth = distance(xyz(&grid, &values), xyz(&fine_grid, &fine_values));
        (check.estimate(&values), truth)
    }

    #[test]
    fn a_thin_film_is_fine_at_10_nm_and_a_thick_one_is_not() {
        let (thin, error) = check(100.0, 10.0);
        assert!(!thin.needs_finer_grid() && error < 1e-4, "{thin:?} {error}");
        let (thick, error) = check(2000.0, 10.0);
        assert!(thick.needs_finer_grid() && error > 1e-4, "{thick:?} {error}");
    }

    #[test]
    fn the_estimate_follows_the_true_error_within_a_factor_of_four() {
        for (thickness, step) in [(500.0, 10.0), (1000.0, 10.0), (2000.0, 5.0)] {
            let (accuracy, error) = check(thickness, step);
            let ratio = accuracy.estimate / error;
            assert!((0.25..4.0).contains(&ratio), "{thickness} {accuracy:?} {error}");
        }
    }

    #[test]
    fn two_samples_cannot_be_thinned() {
        let grid = Grid::new(&[400.0, 700.0]).unwrap();
        let light = Illuminant::named("E").unwrap();
        let check = AccuracyCheck::new(&grid, &light, Observer::Cie1931_2, Extrapolation::Hold);
        assert!(check.is_none());
    }
}
