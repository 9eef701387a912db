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
    LampBasis, colours, models,
    path::{Row, View},
    plan, spectra,
};

/// Points whose directions a model is asked for at once.
const TOGETHER: usize = 256;

/// A point that a camera sees.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfacePoint {
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

/// XYZ of the four Stokes components that the camera sees of every point: ∑ E f cos θ_i, so that a
/// white diffuser that faces a lamp of E = π has Y = 1. s is along [`SurfacePoint::horizontal`].
///
/// # Errors
///
/// As [`super::render`].
pub fn shade(
    material: &Prepared,
    points: &[SurfacePoint],
    lamps: &DistantLamps<'_>,
    wavelengths: &[f64],
    settings: ColourSettings,
    control: &Control,
) -> Result<Vec<[Xyz; 4]>, MaterialError> {
    let plan = plan(wavelengths, settings)?;
    let models = models(material, wavelengths)?;
    let done = AtomicUsize::new(0);
    let some = |some: &[SurfacePoint]| {
        if control.is_cancelled() {
            return Err(MaterialError::Cancelled);
        }
        let row = Row::over_points(some, lamps);
        let spectra = spectra(&row, &models, Stokes(lamps.light), some.len());
        let before = done.fetch_add(some.len(), Ordering::Relaxed);
        control.report((before + some.len()) as f64 / points.len() as f64);
        Ok(colours(&spectra, models.len(), &plan))
    };
    let seen: Result<Vec<_>, _> = points.par_chunks(TOGETHER).map(some).collect();
    let seen = seen?.concat();
    match seen.iter().position(|[i, ..]| !(i.x + i.y + i.z).is_finite()) {
        Some(k) => Err(MaterialError::NotFinite(format!("normal {:.3}", points[k].normal))),
        None => Ok(seen),
    }
}
