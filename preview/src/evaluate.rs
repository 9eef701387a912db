//! Light paths to colours: models at every wavelength, spectra of pixels, XYZ.

use mist_engine::{
    material::{MaterialError, PreparedMaterial},
    request::RequestError,
};
use scattering::{Basis, Model, Side, Stokes};
use spectra::{ColourPlan, ColourSettings, Grid, Xyz};

use crate::path::RowPaths;

/// The plan by which spectra become colours.
pub(crate) fn plan(
    wavelengths: &[f64],
    settings: ColourSettings,
) -> Result<ColourPlan, MaterialError> {
    let refused =
        |part: &str, problem: String| MaterialError::from(RequestError::new(part, problem));
    let grid = Grid::new(wavelengths).map_err(|e| refused("lambda", e.to_string()))?;
    ColourPlan::new(&grid, settings).map_err(|e| refused("adaptation", e.to_string()))
}

/// The models at all `wavelengths` (nm).
///
/// # Errors
///
/// If a model cannot be built, or is not of type 0 (reflection from outside).
pub(crate) fn models(
    material: &PreparedMaterial,
    wavelengths: &[f64],
) -> Result<Vec<Model>, MaterialError> {
    let models = material.models(wavelengths)?;
    if models.iter().any(|model| model.common().side != Side::DownUp) {
        let problem = "a body is seen from outside: type = 0";
        return Err(RequestError::new("type", problem).into());
    }
    Ok(models)
}

/// The spectra of the light paths of a row: per pixel those of the four Stokes components.
pub(crate) fn spectra(row: &RowPaths, models: &[Model], light: Stokes, width: usize) -> Vec<f64> {
    let bands = models.len();
    let mut spectra = vec![0.0; width * 4 * bands];
    for (band, model) in models.iter().enumerate() {
        let matrices = model.evaluate_local(&row.pairs, Basis::Psps);
        for path in &row.paths {
            let stokes = path.stokes_at_camera(&matrices, light);
            for (component, value) in stokes.0.iter().enumerate() {
                spectra[(4 * path.pixel + component) * bands + band] += path.weight * value;
            }
        }
    }
    spectra
}

/// The `pixels` of row `y`.
///
/// # Errors
///
/// If a value is not finite.
pub(crate) fn finite(pixels: Vec<[Xyz; 4]>, y: usize) -> Result<Vec<[Xyz; 4]>, MaterialError> {
    match pixels.iter().position(|[i, ..]| !(i.x + i.y + i.z).is_finite()) {
        Some(x) => Err(MaterialError::NotFinite(format!("pixel {x}, {y}"))),
        None => Ok(pixels),
    }
}

/// XYZ of the `spectra` of pixels.
pub(crate) fn colours(spectra: &[f64], bands: usize, plan: &ColourPlan) -> Vec<[Xyz; 4]> {
    let colour = |pixel: &[f64]| {
        let mut each = pixel.chunks_exact(bands);
        plan.stokes(std::array::from_fn(|_| each.next().unwrap_or_default()))
    };
    spectra.chunks_exact(4 * bands).map(colour).collect()
}
