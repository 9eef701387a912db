//! A colour computation, prepared once: Stokes spectra in, XYZ and linear RGB per component out.
//!
//! Interpolation, filters, illuminant and observer are folded into weights, adaptation and RGB
//! matrix into one matrix. Both are linear, so they hold for signed components too.

use thiserror::Error;

use crate::{
    Illuminant, Observer,
    adaptation::{Adaptation, AdaptationError},
    filter::{Filter, stack_mueller},
    interpolate::{Extrapolation, Resampler},
    matrix::{Matrix3, apply, multiply},
    name::{NamedValue, UnknownName},
    rgb::RgbSpace,
    wavelength::{FINE_COUNT, Fine, Grid, fine_wavelengths},
    weights::{SpectralSensitivity, XyzWeights},
    xyz::{Xyz, to_array},
};

/// The quantity of a spectrum.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Quantity {
    /// BRDF in 1/sr: a perfect diffuser has Y = 1/π.
    #[default]
    Brdf,
    /// Radiance factor π f: a perfect diffuser has Y = 1.
    Factor,
    /// Fraction of the flux: a perfect reflector has Y = 1.
    Reflectance,
    /// Spectral radiance in W/(m² sr nm): the illuminant is ignored, Y is in cd/m².
    Radiance,
}

impl Quantity {
    const NAMES: [NamedValue<Self>; 4] = [
        NamedValue("brdf", Self::Brdf),
        NamedValue("factor", Self::Factor),
        NamedValue("reflectance", Self::Reflectance),
        NamedValue("radiance", Self::Radiance),
    ];

    /// The quantity called `brdf`, `factor`, `reflectance` or `radiance`.
    ///
    /// # Errors
    ///
    /// If it is none of these.
    pub fn parse(text: &str) -> Result<Self, UnknownName> {
        NamedValue::find("quantity", text, &Self::NAMES)
    }

    /// The name that [`parse`](Self::parse) reads.
    pub fn name(self) -> &'static str {
        NamedValue::name_of(&Self::NAMES, self)
    }

    /// The unit of XYZ and RGB: `1/sr`, `1` or `cd/m2`.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Brdf => "1/sr",
            Self::Factor | Self::Reflectance => "1",
            Self::Radiance => "cd/m2",
        }
    }
}

/// The settings of a colour computation.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourSettings {
    /// The quantity of the values.
    pub quantity: Quantity,
    /// The light; ignored for [`Quantity::Radiance`].
    pub illuminant: Illuminant,
    /// The observer.
    pub observer: Observer,
    /// The RGB space.
    pub space: RgbSpace,
    /// The adaptation from the white of the light to that of the space; not used for
    /// [`Quantity::Radiance`], which has no white.
    pub adaptation: Adaptation,
    /// Filters before the eye, in the order in which light meets them.
    pub filters: Vec<Filter>,
    /// The values of the spectra outside their samples.
    pub outside: Extrapolation,
}

/// Errors of preparing a colour computation.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PlanError {
    /// The adaptation does not apply to the white of the light or of the space.
    #[error(transparent)]
    Adaptation(#[from] AdaptationError),
}

/// A prepared colour computation for spectra on one grid.
#[derive(Clone, Debug)]
pub struct ColourPlan {
    settings: ColourSettings,
    samples: usize,
    /// `weights[out][in]`: the contribution of component `in` before the filters to `out` behind them;
    /// `None` where it is zero at every wavelength.
    weights: [[Option<XyzWeights>; 4]; 4],
    white: Option<Xyz>,
    to_rgb: Matrix3,
}

impl ColourPlan {
    /// Prepares the computation for spectra on `grid`.
    ///
    /// # Errors
    ///
    /// If the adaptation does not apply to the whites.
    pub fn new(grid: &Grid, settings: ColourSettings) -> Result<Self, PlanError> {
        let absolute = settings.quantity == Quantity::Radiance;
        let white = (!absolute).then(|| settings.illuminant.white(settings.observer));
        let sensitivity = if absolute {
            SpectralSensitivity::absolute(settings.observer)
        } else {
            SpectralSensitivity::relative(&settings.illuminant, settings.observer)
        };
        let to_rgb = match white {
            Some(white) => rgb_matrix(&settings.space, settings.adaptation, white)?,
            None => *settings.space.from_xyz_matrix(),
        };
        let resampler = Resampler::for_grid(grid, settings.outside);
        let weights = filter_weights(grid, &resampler, &settings.filters, &sensitivity);
        Ok(Self { settings, samples: grid.len(), weights, white, to_rgb })
    }

    /// The settings of the plan.
    pub fn settings(&self) -> &ColourSettings {
        &self.settings
    }

    /// XYZ of a perfect diffuser under the light, Y = 1; none for radiance.
    pub fn white(&self) -> Option<Xyz> {
        self.white
    }

    /// XYZ of the four Stokes components behind the filters.
    ///
    /// Each component has one value per wavelength, in the order in which the wavelengths were
    /// given; an empty slice stands for a component that is zero.
    ///
    /// # Panics
    ///
    /// If a component has another number of values.
    pub fn stokes(&self, components: [&[f64]; 4]) -> [Xyz; 4] {
        for component in components {
            let fits = component.is_empty() || component.len() == self.samples;
            assert!(fits, "one value per wavelength, or none");
        }
        [0, 1, 2, 3].map(|out| {
            let contributions = self.weights[out].iter().zip(components);
            contributions
                .filter(|(_, component)| !component.is_empty())
                .filter_map(|(weights, component)| Some(weights.as_ref()?.xyz(component)))
                .fold(Xyz::new(0.0, 0.0, 0.0), |sum, xyz| sum + xyz)
        })
    }

    /// XYZ behind the filters of unpolarized light.
    ///
    /// # Panics
    ///
    /// If there is not one value per wavelength.
    pub fn unpolarized(&self, intensity: &[f64]) -> Xyz {
        self.stokes([intensity, &[], &[], &[]])[0]
    }

    /// Linear RGB of the XYZ of a component: adapted, signed, unclipped.
    pub fn rgb(&self, xyz: Xyz) -> [f64; 3] {
        apply(&self.to_rgb, to_array(xyz))
    }
}

/// The matrix from XYZ under a light of white `white` to linear RGB.
///
/// # Errors
///
/// If the adaptation does not apply to the whites.
pub fn rgb_matrix(
    space: &RgbSpace,
    adaptation: Adaptation,
    white: Xyz,
) -> Result<Matrix3, AdaptationError> {
    Ok(multiply(space.from_xyz_matrix(), &adaptation.matrix(white, space.white())?))
}

fn filter_weights(
    grid: &Grid,
    resampler: &Resampler<'_>,
    filters: &[Filter],
    sensitivity: &SpectralSensitivity,
) -> [[Option<XyzWeights>; 4]; 4] {
    if filters.is_empty() {
        let direct = XyzWeights::fold(grid, resampler, sensitivity);
        return [0, 1, 2, 3]
            .map(|out| [0, 1, 2, 3].map(|input| (out == input).then(|| direct.clone())));
    }
    let mueller: Vec<_> = fine_wavelengths().map(|nm| stack_mueller(filters, nm)).collect();
    [0, 1, 2, 3].map(|out| {
        let passed = [0, 1, 2, 3].map(|input| {
            let mut passed: Box<Fine> = Box::new([0.0; FINE_COUNT]);
            for (passed, mueller) in passed.iter_mut().zip(&mueller) {
                *passed = mueller[out][input];
            }
            passed
        });
        let behind = passed.each_ref().map(|passed| sensitivity.behind(passed));
        let mut folded = XyzWeights::fold_each(grid, resampler, behind.each_ref()).map(Some);
        for (weights, passed) in folded.iter_mut().zip(&passed) {
            if passed.iter().all(|element| *element == 0.0) {
                *weights = None;
            }
        }
        folded
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

    use proptest::prelude::*;

    use super::*;
    use crate::{filter, xyz};

    fn settings(filters: Vec<Filter>) -> ColourSettings {
        ColourSettings {
            quantity: Quantity::Brdf,
            illuminant: Illuminant::named("D65").unwrap(),
            observer: Observer::Cie1931_2,
            space: RgbSpace::srgb(),
            adaptation: Adaptation::Bradford,
            filters,
            outside: Extrapolation::Hold,
        }
    }

    fn paper_grid() -> (Grid, Vec<f64>) {
        let nm: Vec<f64> = (0..40).map(|i| 360.0 + 10.0 * f64::from(i)).collect();
        (Grid::new(&nm).unwrap(), nm)
    }

    #[test]
    fn a_grey_spectrum_has_equal_channels_equal_to_the_intensity() {
        let (grid, _) = paper_grid();
        let plan = ColourPlan::new(&grid, settings(vec![])).unwrap();
        let xyz = plan.unpolarized(&[FRAC_1_PI; 40]);
        // 40 products and the matrices: a few roundings of numbers below one.
        assert!((xyz.y - FRAC_1_PI).abs() < 1e-15, "{}", xyz.y - FRAC_1_PI);
        for channel in plan.rgb(xyz) {
            assert!((channel - FRAC_1_PI).abs() < 2e-15, "{}", channel - FRAC_1_PI);
        }
    }

    #[test]
    fn filters_in_the_plan_act_as_on_the_1_nm_grid() {
        let (grid, nm) = paper_grid();
        let filters =
            vec![Filter::retarder(0.7, 560.0).unwrap(), Filter::linear(0.2, 0.9, 0.01).unwrap()];
        let plan = ColourPlan::new(&grid, settings(filters.clone())).unwrap();
        let spectra = [0.0, 0.5, 1.0, 1.5]
            .map(|phase: f64| nm.iter().map(|nm| (nm / 80.0 + phase).sin()).collect::<Vec<f64>>());

        let fine =
            spectra.each_ref().map(|s| Resampler::for_grid(&grid, Extrapolation::Hold).fine(s));
        let mut behind = [[0.0; FINE_COUNT]; 4];
        for (i, nm) in fine_wavelengths().enumerate() {
            let stokes = [0, 1, 2, 3].map(|k| fine[k][i]);
            let passed = filter::apply(&stack_mueller(&filters, nm), stokes);
            for k in 0..4 {
                behind[k][i] = passed[k];
            }
        }
        let planned = plan.stokes(spectra.each_ref().map(Vec::as_slice));
        for (planned, behind) in planned.into_iter().zip(&behind) {
            let direct = xyz::reflected(behind, &plan.settings().illuminant, Observer::Cie1931_2);
            for (a, b) in to_array(planned).into_iter().zip(to_array(direct)) {
                // Rounding of 471 additions.
                assert!((a - b).abs() < 1e-14, "{a} {b}");
            }
        }
    }

    #[test]
    fn radiance_has_neither_white_nor_adaptation() {
        let (grid, _) = paper_grid();
        let plan = ColourPlan::new(
            &grid,
            ColourSettings {
                quantity: Quantity::Radiance,
                outside: Extrapolation::Zero,
                ..settings(vec![])
            },
        )
        .unwrap();
        assert_eq!(plan.white(), None);
        let xyz = plan.unpolarized(&[0.001; 40]);
        assert_eq!(plan.rgb(xyz), RgbSpace::srgb().linear(xyz));
        // 683 · 0.001 · Σ ȳ from 360 to 750 nm; ȳ above 750 nm adds 3e-4 of 106.857.
        assert!((xyz.y - 0.683 * 106.857).abs() < 0.01, "{}", xyz.y);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        #[test]
        fn orthogonal_polarizers_add_up_to_no_filter(
            angle in -4.0..4.0,
            levels in prop::collection::vec(-1.0..1.0, 16),
        ) {
            let (grid, nm) = paper_grid();
            let spectra = [0, 4, 8, 12].map(|k| {
                nm.iter().map(|nm| levels[k] + levels[k + 1] * (nm / 90.0).sin()).collect::<Vec<f64>>()
            });
            let spectra = spectra.each_ref().map(Vec::as_slice);
            let through = |filters| ColourPlan::new(&grid, settings(filters)).unwrap().stokes(spectra)[0];
            let bare = through(vec![]);
            let sum = through(vec![Filter::linear(angle, 1.0, 0.0).unwrap()])
                + through(vec![Filter::linear(angle + FRAC_PI_2, 1.0, 0.0).unwrap()]);
            for (a, b) in to_array(bare).into_iter().zip(to_array(sum)) {
                // 2·(angle + 90°) is rounded by 4e-16 and the sums of 40 terms likewise.
                prop_assert!((a - b).abs() < 5e-15, "{a} {b}");
            }
        }

        #[test]
        fn physical_light_is_not_negative_behind_a_polarizer(
            angle in -4.0..4.0,
            degree in 0.0..1.0,
            direction in -4.0..4.0,
        ) {
            let (grid, nm) = paper_grid();
            let filter = Filter::linear(angle, 1.0, 0.0).unwrap();
            let plan = ColourPlan::new(&grid, settings(vec![filter])).unwrap();
            // Slow enough for the interpolation not to overshoot below zero.
            let i: Vec<f64> = nm.iter().map(|nm| 1.2 + (nm / 100.0).sin()).collect();
            let q: Vec<f64> = i.iter().map(|i| i * degree * f64::cos(direction)).collect();
            let u: Vec<f64> = i.iter().map(|i| i * degree * f64::sin(direction)).collect();
            let xyz = plan.stokes([&i, &q, &u, &[]])[0];
            prop_assert!(xyz.x > -1e-15 && xyz.y > -1e-15 && xyz.z > -1e-15);
        }
    }
}
