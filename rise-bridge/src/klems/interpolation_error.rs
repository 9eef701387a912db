//! The error of a table of patches.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::{
    basis::{KlemsPatch, containing, patches},
    mean::{MeansUnderLight, equal_energy},
};
use crate::export::{Bands, ExportError, InterpolationError, r4_sequence};

/// The relative difference between the luminous f of a patch and that of directions inside it: the
/// error of a reader that uses patches as constants.
///
/// # Errors
///
/// If the wavelengths give no colour.
pub fn interpolation_error(bands: &Bands) -> Result<InterpolationError, ExportError> {
    let plan = equal_energy(bands)?;
    let patches = patches();
    let hemisphere = KlemsPatch { lower: 0.0, upper: FRAC_PI_2, phi: 0.0, width: TAU };
    Ok(InterpolationError::measure(|n| {
        let [a, b, c, d] = r4_sequence(n);
        let (light, leaving) = (hemisphere.direction(a, b), hemisphere.direction(c, d));
        let middle = patches[containing(light)].centre();
        let patch = MeansUnderLight::new(bands, &plan, middle).xyz(&patches[containing(leaving)]);
        let spectrum: Vec<f64> = bands.unpolarized(light, leaving).collect();
        let (Ok(patch), exact) = (patch, plan.unpolarized(&spectrum).y) else { return Vec::new() };
        // Directions are uniform in projected solid angle.
        let compared = (exact > 0.0).then(|| ((patch[1] - exact).abs() / exact, exact));
        compared.into_iter().collect()
    }))
}
