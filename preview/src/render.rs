//! Renders a scene row by row.

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::DVec3;
use mist_engine::{
    Control,
    material::{MaterialError, PreparedMaterial},
};
use rayon::prelude::*;
use scattering::{Model, Stokes};
use spectra::{ColourPlan, ColourSettings};

use crate::{
    evaluate::{colours, finite, models, plan, spectra},
    film::RenderedFilm,
    path::RowPaths,
    response::NormalResponse,
    scene::{Lamp, Scene},
};

/// Renders `material` at `wavelengths` (nm, rising).
///
/// # Errors
///
/// For values that the model cannot take, models that are not of type 0, wavelengths and colours
/// that do not fit, values that are not finite, and on cancellation.
pub fn render(
    material: &PreparedMaterial,
    scene: &Scene,
    wavelengths: &[f64],
    settings: ColourSettings,
    control: &Control,
) -> Result<RenderedFilm, MaterialError> {
    let plan = plan(wavelengths, settings)?;
    let models = models(material, wavelengths)?;
    let light = Stokes(scene.light);
    let responses = responses(scene, &models, &plan);
    let [width, height] = scene.size;
    let done = AtomicUsize::new(0);
    let rows = (0..height)
        .into_par_iter()
        .map(|y| {
            if control.is_cancelled() {
                return Err(MaterialError::Cancelled);
            }
            let row = RowPaths::trace(scene, &responses, y);
            let spectra = spectra(&row, &models, light, width);
            let mut pixels = colours(&spectra, models.len(), &plan);
            for (x, known) in &row.known {
                pixels[*x].iter_mut().zip(known).for_each(|(sum, xyz)| *sum += *xyz);
            }
            let before = done.fetch_add(1, Ordering::Relaxed);
            control.report((before + 1) as f64 / height as f64);
            let kept = spectra.into_iter().filter(|_| scene.spectra).map(|x| x as f32).collect();
            Ok((finite(pixels, y)?, kept))
        })
        .collect::<Result<(Vec<_>, Vec<Vec<f32>>), MaterialError>>()?;
    Ok(RenderedFilm { size: scene.size, pixels: rows.0.concat(), spectra: rows.1.concat() })
}

/// For each lamp in one direction its response as a function of the normal.
fn responses(scene: &Scene, models: &[Model], plan: &ColourPlan) -> Vec<Option<NormalResponse>> {
    if scene.exact || scene.spectra {
        return Vec::new();
    }
    let light = Stokes(scene.light);
    // A plane has one normal and as many samples as a sphere: an eighth of them bounds the loss.
    let most = scene.size[0] * scene.size[1] * scene.samples / 8;
    let response = |lamp: &Lamp| {
        (lamp.radius == 0.0).then(|| {
            NormalResponse::new(lamp.toward, most, &|normals: &[DVec3]| {
                let row = RowPaths::over_normals(scene, lamp.toward, normals);
                let spectra = spectra(&row, models, light, normals.len());
                colours(&spectra, models.len(), plan)
            })
        })
    };
    scene.lamps.iter().map(response).collect()
}
