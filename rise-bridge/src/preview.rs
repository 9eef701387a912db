//! A small exact renderer: one material on one body, lamps, a camera with a filter before it.
//!
//! The camera looks along −z from far away; x is to the right and y up, and Stokes vectors arrive
//! with s along x: Q > 0 is horizontal light. A pixel is the radiance factor
//!
//! $$ S = \pi \sum_\text{lamps} E\, R_c\, f(\omega_o, \omega_i)\, R_l\, \Phi \cos\theta_i
//!      + \pi \int f\, L\, \cos\theta_i \, d\omega_i $$
//!
//! so a white diffuser that faces a lamp of E = 1 has the value 1. f is the Mueller BRDF of the
//! model at every wavelength and azimuth; R turn Stokes vectors between the bases of the surface
//! point, of the lamp and of the camera. The second term holds the sky, which is unpolarized, and
//! one bounce between points of the body, with its Stokes vector: both are sampled
//! with a density proportional to cos θ_i. Random numbers are a function of pixel, sample and
//! dimension, so the picture has the same bits on any number of threads.
//!
//! For lamps in one direction the first term is a function of the normal alone; it is interpolated
//! between normals within 1 ‰ (`preview/response.rs`) unless [`Scene::exact`] or spectra are asked
//! for, which evaluate the model for every sample.
//!
//! Limits: no light passes through the body (models of `type` 0 only), lamps are far away, and a
//! sky seen in a narrow highlight is noisy.

pub mod mesh;
pub mod shape;

mod frame;
mod path;
mod picture;
mod points;
mod random;
mod response;
mod sky;
mod spectral;
mod turn;

use glam::DVec3;
use mist_engine::{
    Control,
    material::{MaterialError, Prepared},
};
use rayon::prelude::*;
use scattering::{Basis, Model, Side, Stokes};
use spectra::{ColourPlan, ColourSettings, Grid, Xyz};

pub use picture::{Polarization, brightest, picture, side_by_side};
pub use points::{DistantLamps, SurfacePoint, shade};
pub use shape::Shape;
pub use sky::{Environment, Sky};
pub use spectral::spectral_exr;

use path::Row;
use response::Response;

/// A lamp far away: a disc of directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    /// Unit vector to its centre.
    pub toward: DVec3,
    /// Half-angle of the disc, rad; 0 is one direction.
    pub radius: f64,
    /// Irradiance on a surface that faces it; 1 is the unit of the picture.
    pub irradiance: f64,
}

impl Lamp {
    /// The lamp at a polar angle from the view and an azimuth from the right, counter-clockwise.
    pub fn at(polar: f64, azimuth: f64, radius: f64, irradiance: f64) -> Self {
        let (sin, cos) = polar.sin_cos();
        let toward = DVec3::new(sin * azimuth.cos(), sin * azimuth.sin(), cos).normalize();
        Self { toward, radius, irradiance }
    }
}

/// The basis in which the polarization of the lamps is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LampBasis {
    /// s is perpendicular to the plane of incidence at every point of the body.
    PlaneOfIncidence,
    /// s is horizontal.
    Horizontal,
}

/// What is rendered.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The body; it fills the unit sphere.
    pub shape: Shape,
    /// The lamps.
    pub lamps: Vec<Lamp>,
    /// Stokes vector of their light; its first component is 1.
    pub light: [f64; 4],
    /// The basis of that vector.
    pub light_basis: LampBasis,
    /// The surroundings.
    pub sky: Sky,
    /// Whether points of the body light each other, once.
    pub bounce: bool,
    /// Columns and rows.
    pub size: [usize; 2],
    /// Samples per pixel.
    pub samples: usize,
    /// Whether the model is evaluated for every sample.
    pub exact: bool,
    /// Whether the film keeps spectra, which evaluates the model for every sample too.
    pub spectra: bool,
}

/// A rendered picture: XYZ of the four Stokes components per pixel, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// Columns and rows.
    pub size: [usize; 2],
    /// XYZ of I, Q, U and V; Y = 1 is a white diffuser that faces a lamp of irradiance 1.
    pub pixels: Vec<[Xyz; 4]>,
    /// Radiance factors of the pixels if [`Scene::spectra`] asks for them, else nothing: per pixel
    /// the spectra of I, Q, U and V.
    pub spectra: Vec<f32>,
}

/// Renders `material` at `wavelengths` (nm, rising).
///
/// # Errors
///
/// For values that the model cannot take, models that are not of type 0, wavelengths and colours
/// that do not fit, values that are not finite, and a wish to stop.
pub fn render(
    material: &Prepared,
    scene: &Scene,
    wavelengths: &[f64],
    settings: ColourSettings,
    control: &Control,
) -> Result<Film, MaterialError> {
    let plan = plan(wavelengths, settings)?;
    let models = models(material, wavelengths)?;
    let light = Stokes(scene.light);
    let responses = responses(scene, &models, &plan);
    let [width, height] = scene.size;
    let done = std::sync::atomic::AtomicUsize::new(0);
    let rows = (0..height)
        .into_par_iter()
        .map(|y| {
            if control.is_cancelled() {
                return Err(MaterialError::Cancelled);
            }
            let row = Row::trace(scene, &responses, y);
            let spectra = spectra(&row, &models, light, width);
            let mut pixels = colours(&spectra, models.len(), &plan);
            for (x, known) in &row.known {
                pixels[*x].iter_mut().zip(known).for_each(|(sum, xyz)| *sum += *xyz);
            }
            let before = done.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            control.report((before + 1) as f64 / height as f64);
            let kept = spectra.into_iter().filter(|_| scene.spectra).map(|x| x as f32).collect();
            Ok((finite(pixels, y)?, kept))
        })
        .collect::<Result<(Vec<_>, Vec<Vec<f32>>), MaterialError>>()?;
    Ok(Film { size: scene.size, pixels: rows.0.concat(), spectra: rows.1.concat() })
}

/// How spectra become colours.
fn plan(wavelengths: &[f64], settings: ColourSettings) -> Result<ColourPlan, MaterialError> {
    let refused =
        |part: &str, problem: String| MaterialError::Request { part: part.into(), problem };
    let grid = Grid::new(wavelengths).map_err(|e| refused("lambda", e.to_string()))?;
    ColourPlan::new(&grid, settings).map_err(|e| refused("adaptation", e.to_string()))
}

/// The models at all wavelengths (nm), which must be those of a body seen from outside.
fn models(material: &Prepared, wavelengths: &[f64]) -> Result<Vec<Model>, MaterialError> {
    let models = wavelengths
        .par_iter()
        .map(|nm| Ok(material.at(nm / 1000.0).model()?.0))
        .collect::<Result<Vec<Model>, MaterialError>>()?;
    if models.iter().any(|model| model.common().side != Side::DownUp) {
        let problem = "a body is seen from outside: type = 0".into();
        return Err(MaterialError::Request { part: "type".into(), problem });
    }
    Ok(models)
}

/// For each lamp in one direction what the camera sees of it, by the normal.
fn responses(scene: &Scene, models: &[Model], plan: &ColourPlan) -> Vec<Option<Response>> {
    if scene.exact || scene.spectra {
        return Vec::new();
    }
    let light = Stokes(scene.light);
    // A plane has one normal, and as many samples as a sphere: an eighth of them is no loss.
    let most = scene.size[0] * scene.size[1] * scene.samples / 8;
    let response = |lamp: &Lamp| {
        (lamp.radius == 0.0).then(|| {
            Response::new(lamp.toward, most, &|normals: &[DVec3]| {
                let row = Row::over_normals(scene, lamp.toward, normals);
                let spectra = spectra(&row, models, light, normals.len());
                colours(&spectra, models.len(), plan)
            })
        })
    };
    scene.lamps.iter().map(response).collect()
}

/// The spectra of the ways of light of a row: per pixel those of the four Stokes components.
fn spectra(row: &Row, models: &[Model], light: Stokes, width: usize) -> Vec<f64> {
    let bands = models.len();
    let mut spectra = vec![0.0; width * 4 * bands];
    for (band, model) in models.iter().enumerate() {
        let matrices = model.evaluate_local(&row.pairs, Basis::Psps);
        for path in &row.paths {
            let seen = path.seen(&matrices, light);
            for (component, value) in seen.0.iter().enumerate() {
                spectra[(4 * path.pixel + component) * bands + band] += path.weight * value;
            }
        }
    }
    spectra
}

/// The `pixels` of row `y`, which must be numbers.
fn finite(pixels: Vec<[Xyz; 4]>, y: usize) -> Result<Vec<[Xyz; 4]>, MaterialError> {
    match pixels.iter().position(|[i, ..]| !(i.x + i.y + i.z).is_finite()) {
        Some(x) => Err(MaterialError::NotFinite(format!("pixel {x}, {y}"))),
        None => Ok(pixels),
    }
}

/// XYZ of the `spectra` of pixels.
fn colours(spectra: &[f64], bands: usize, plan: &ColourPlan) -> Vec<[Xyz; 4]> {
    let colour = |pixel: &[f64]| {
        let mut each = pixel.chunks_exact(bands);
        plan.stokes(std::array::from_fn(|_| each.next().unwrap_or_default()))
    };
    spectra.chunks_exact(4 * bands).map(colour).collect()
}
