//! XYZ of the mean BRDF of a patch.

use glam::DVec3;
use mist_engine::{material::MaterialError, request::ColourQuery};
use spectra::{ColourPlan, Grid};

use super::basis::KlemsPatch;
use crate::export::{Bands, ExportError};

/// Directions along each side of a patch.
const SAMPLES: usize = 4;

/// The plan of CIE XYZ under equal energy.
pub(super) fn equal_energy(bands: &Bands) -> Result<ColourPlan, ExportError> {
    let wrong =
        |error: &dyn std::fmt::Display| ExportError::refused("wavelengths", error.to_string());
    let grid = Grid::new(bands.nm()).map_err(|error| wrong(&error))?;
    let names = ColourQuery { illuminant: Some("E".into()), ..ColourQuery::default() };
    ColourPlan::new(&grid, names.settings(None)?).map_err(|error| wrong(&error))
}

/// XYZ of the mean BRDF over the patch `to`.
pub(super) fn mean(
    bands: &Bands,
    plan: &ColourPlan,
    light: DVec3,
    to: &KlemsPatch,
) -> Result<[f64; 3], ExportError> {
    let mut spectrum = vec![0.0; bands.nm().len()];
    for k in 0..SAMPLES * SAMPLES {
        let [u, w] = [k / SAMPLES, k % SAMPLES].map(|i| (i as f64 + 0.5) / SAMPLES as f64);
        for (sum, f) in spectrum.iter_mut().zip(bands.unpolarized(light, to.direction(u, w))) {
            *sum += f / (SAMPLES * SAMPLES) as f64;
        }
    }
    if let Some(bad) = spectrum.iter().position(|f| !f.is_finite()) {
        let place = format!("light from {light:.3}, {} nm", bands.nm()[bad]);
        return Err(MaterialError::NotFinite(place).into());
    }
    let xyz = plan.unpolarized(&spectrum);
    Ok([xyz.x, xyz.y, xyz.z].map(|x| x.max(0.0)))
}
