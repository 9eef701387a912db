//! Precomputed weights: XYZ as one product of the samples with an n × 3 table.
//!
//! Interpolation to 1 nm and the sum are linear in the samples R, so XYZ = Wᵀ R with
//! W = Aᵀ diag(S) C / Σ S ȳ, where A interpolates, S is the light and C the observer. W depends on
//! the wavelengths, the illuminant and the observer only: compute it once per job.

use crate::{
    Illuminant, Observer,
    interpolate::{Extrapolation, Resampler},
    observer::FineXyz,
    wavelength::{FINE_COUNT, Fine, Grid},
    xyz::{self, LUMINOUS_EFFICACY, Xyz},
};

/// Weights of the samples of a spectrum in its XYZ.
#[derive(Clone, Debug, PartialEq)]
pub struct XyzWeights {
    /// In the order in which the wavelengths were given.
    rows: Vec<[f64; 3]>,
}

impl XyzWeights {
    /// Weights for reflectances under an illuminant: a perfect diffuser has Y = 1.
    ///
    /// Interpolated by what [`Interpolation::for_grid`](crate::Interpolation::for_grid) chooses.
    pub fn new(
        grid: &Grid,
        illuminant: &Illuminant,
        observer: Observer,
        outside: Extrapolation,
    ) -> Self {
        let resampler = Resampler::for_grid(grid, outside);
        Self::fold(grid, &resampler, &SpectralSensitivity::relative(illuminant, observer))
    }

    /// Weights for spectral radiances in W/(m² sr nm): Y in cd/m².
    pub fn absolute(grid: &Grid, observer: Observer, outside: Extrapolation) -> Self {
        let resampler = Resampler::for_grid(grid, outside);
        Self::fold(grid, &resampler, &SpectralSensitivity::absolute(observer))
    }

    /// Folds an interpolation and a sensitivity into weights.
    pub(crate) fn fold(grid: &Grid, resampler: &Resampler<'_>, to: &SpectralSensitivity) -> Self {
        let [weights] = Self::fold_each(grid, resampler, [to]);
        weights
    }

    /// The same for several sensitivities, with the interpolation done once.
    pub(crate) fn fold_each<const N: usize>(
        grid: &Grid,
        resampler: &Resampler<'_>,
        to: [&SpectralSensitivity; N],
    ) -> [Self; N] {
        let mut each = to.map(|_| Self { rows: vec![[0.0; 3]; grid.len()] });
        for (k, column) in resampler.columns().enumerate() {
            for (weights, to) in each.iter_mut().zip(to) {
                weights.rows[grid.given_position(k)] = to.sum(&column);
            }
        }
        each
    }

    /// Weights on every other wavelength of `grid`, as weights on all of them.
    pub(crate) fn on_full_grid(&self, grid: &Grid) -> Self {
        let mut rows = vec![[0.0; 3]; grid.len()];
        for (k, row) in self.rows.iter().enumerate() {
            rows[grid.given_position(2 * k)] = *row;
        }
        Self { rows }
    }

    /// XYZ of a spectrum whose samples are in the order in which the wavelengths were given.
    ///
    /// # Panics
    ///
    /// If there are not as many samples as wavelengths.
    pub fn xyz(&self, values: &[f64]) -> Xyz {
        assert_eq!(values.len(), self.rows.len(), "one value per wavelength");
        let mut sum = [0.0; 3];
        for (value, row) in values.iter().zip(&self.rows) {
            for (sum, weight) in sum.iter_mut().zip(row) {
                *sum += value * weight;
            }
        }
        xyz::from_array(sum)
    }

    /// The weights, one row per wavelength as given.
    pub fn rows(&self) -> &[[f64; 3]] {
        &self.rows
    }
}

/// The contribution of one nanometre to X, Y and Z, on the 1 nm grid.
#[derive(Clone, Debug)]
pub(crate) struct SpectralSensitivity(Box<FineXyz>);

impl SpectralSensitivity {
    /// S c̄ / Σ S ȳ.
    pub(crate) fn relative(illuminant: &Illuminant, observer: Observer) -> Self {
        let luminance = illuminant.luminance(observer);
        Self::per_nanometre(observer, |i| illuminant.fine()[i] / luminance)
    }

    /// 683 c̄.
    pub(crate) fn absolute(observer: Observer) -> Self {
        Self::per_nanometre(observer, |_| LUMINOUS_EFFICACY)
    }

    fn per_nanometre(observer: Observer, factor: impl Fn(usize) -> f64) -> Self {
        let mut table = Box::new(*observer.functions());
        for (i, row) in table.iter_mut().enumerate() {
            *row = row.map(|c| c * factor(i));
        }
        Self(table)
    }

    /// The same behind something that passes the fraction `transmittance` (which may be signed).
    pub(crate) fn behind(&self, transmittance: &Fine) -> Self {
        let mut table = Box::new([[0.0; 3]; FINE_COUNT]);
        for ((out, row), t) in table.iter_mut().zip(self.0.iter()).zip(transmittance) {
            *out = row.map(|c| c * t);
        }
        Self(table)
    }

    fn sum(&self, values: &Fine) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (value, row) in values.iter().zip(self.0.iter()) {
            for (sum, c) in sum.iter_mut().zip(row) {
                *sum += value * c;
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn wavelengths() -> impl Strategy<Value = Vec<f64>> {
        let uniform = (350.0..450.0, 1.0..30.0, 2_usize..40).prop_map(|(first, step, n)| {
            (0..n).map(|i| first + step * i as f64).collect::<Vec<f64>>()
        });
        let uneven =
            (350.0..450.0, prop::collection::vec(2.0..30.0, 1..30)).prop_map(|(first, steps)| {
                let mut nm = vec![first];
                nm.extend(steps.iter().scan(first, |at, step| {
                    *at += step;
                    Some(*at)
                }));
                nm.reverse();
                nm
            });
        prop_oneof![uniform, uneven]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn weights_give_what_interpolating_and_summing_gives(
            nm in wavelengths(),
            values in prop::collection::vec(-1.0..1.0, 40),
            hold in any::<bool>(),
        ) {
            let grid = Grid::new(&nm).unwrap();
            let values = &values[..nm.len().min(40)];
            prop_assume!(values.len() == nm.len());
            let light = Illuminant::named("D65").unwrap();
            let outside = if hold { Extrapolation::Hold } else { Extrapolation::Zero };

            let fine = Resampler::for_grid(&grid, outside).fine(&grid.sort(values).unwrap());
            let direct = xyz::reflected(&fine, &light, Observer::Cie1931_2);
            let weighted = XyzWeights::new(&grid, &light, Observer::Cie1931_2, outside).xyz(values);

            for (a, b) in xyz::to_array(direct).into_iter().zip(xyz::to_array(weighted)) {
                // Rounding of 471 additions of terms of both signs; overshoot makes them larger.
                prop_assert!((a - b).abs() <= 1e-14 * b.abs().max(1.0), "{a} {b}");
            }
        }
    }

    #[test]
    fn absolute_weights_give_what_the_sum_gives() {
        let nm: Vec<f64> = (0..48).map(|i| 360.0 + 10.0 * f64::from(i)).collect();
        let grid = Grid::new(&nm).unwrap();
        let radiance: Vec<f64> = nm.iter().map(|nm| 1e-3 * (nm / 50.0).cos()).collect();
        let fine = Resampler::for_grid(&grid, Extrapolation::Zero).fine(&radiance);
        let direct = xyz::emitted(&fine, Observer::Cie1964_10);
        let weights = XyzWeights::absolute(&grid, Observer::Cie1964_10, Extrapolation::Zero);
        let weighted = weights.xyz(&radiance);
        // 471 additions of terms up to 1.
        assert!((direct.y - weighted.y).abs() < 1e-12, "{} {}", direct.y, weighted.y);
    }
}
