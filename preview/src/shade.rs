//! Shading of surface points that another renderer found, under distant lamps.

use std::sync::atomic::{AtomicUsize, Ordering};

use mist_engine::{
    Control,
    material::{MaterialError, PreparedMaterial},
};
use rayon::prelude::*;
use scattering::Stokes;
use spectra::{ColourSettings, Xyz};

use crate::{
    evaluate::{colours, finite, models, plan, spectra},
    path::RowPaths,
    surface_point::{DistantLamps, SurfacePoint},
};

/// XYZ of the four Stokes components in every pixel of a picture (columns and rows), row by row from
/// the top; `points` gives the surface points of a row.
///
/// Values are ∑ E f cos θ_i: a white diffuser that faces a lamp of E = π has Y = 1. s is along
/// [`SurfacePoint::horizontal`].
///
/// # Errors
///
/// As [`render`](fn@crate::render).
pub fn shade(
    material: &PreparedMaterial,
    [width, height]: [usize; 2],
    points: impl Fn(usize) -> Vec<SurfacePoint> + Sync,
    lamps: &DistantLamps<'_>,
    (wavelengths, settings): (&[f64], ColourSettings),
    control: &Control,
) -> Result<Vec<[Xyz; 4]>, MaterialError> {
    let plan = plan(wavelengths, settings)?;
    let models = models(material, wavelengths)?;
    let done = AtomicUsize::new(0);
    let row = |y: usize| {
        if control.is_cancelled() {
            return Err(MaterialError::Cancelled);
        }
        let row = RowPaths::over_points(&points(y), lamps);
        let spectra = spectra(&row, &models, Stokes(lamps.light), width);
        let before = done.fetch_add(1, Ordering::Relaxed);
        control.report((before + 1) as f64 / height as f64);
        finite(colours(&spectra, models.len(), &plan), y)
    };
    let rows: Result<Vec<_>, _> = (0..height).into_par_iter().map(row).collect();
    Ok(rows?.concat())
}
