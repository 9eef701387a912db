//! Points of surfaces that another renderer found, in the light of lamps far away.

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::DVec3;
use mist_engine::{
    Control,
    material::{MaterialError, Prepared},
};
use rayon::prelude::*;
use scattering::Stokes;
use spectra::{ColourSettings, Xyz};

use super::{
    LampBasis, colours, finite, models,
    path::{Row, View},
    plan, spectra,
};

/// A point that a camera sees.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The column of the pixel that shows it.
    pub column: usize,
    /// Its part of the pixel.
    pub part: f64,
    /// Unit vector away from the body.
    pub normal: DVec3,
    /// Unit vector to the camera.
    pub to_camera: DVec3,
    /// Unit vector across that one which is horizontal in the picture, to the right.
    pub horizontal: DVec3,
    /// Irradiance of each lamp on a surface here that faces it; 0 in its shadow.
    pub irradiances: Vec<f64>,
}

impl SurfacePoint {
    pub(super) fn view(&self) -> View {
        View { to_camera: self.to_camera, horizontal: self.horizontal }
    }
}

/// The lamps of [`shade`].
#[derive(Clone, Copy, Debug)]
pub struct DistantLamps<'a> {
    /// Unit vectors to them.
    pub toward: &'a [DVec3],
    /// Stokes vector of their light; its first component is 1.
    pub light: [f64; 4],
    /// The basis of that vector.
    pub light_basis: LampBasis,
}

/// XYZ of the four Stokes components in every pixel of a picture of this `size` (columns and rows),
/// row by row from the top; `points` are those of a row.
///
/// They are ∑ E f cos θ_i, so that a white diffuser that faces a lamp of E = π has Y = 1. s is along
/// [`SurfacePoint::horizontal`].
///
/// # Errors
///
/// As [`super::render`].
pub fn shade(
    material: &Prepared,
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
        let row = Row::over_points(&points(y), lamps);
        let spectra = spectra(&row, &models, Stokes(lamps.light), width);
        let before = done.fetch_add(1, Ordering::Relaxed);
        control.report((before + 1) as f64 / height as f64);
        finite(colours(&spectra, models.len(), &plan), y)
    };
    let rows: Result<Vec<_>, _> = (0..height).into_par_iter().map(row).collect();
    Ok(rows?.concat())
}
