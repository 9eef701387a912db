//! The scene: a body, its lamps and its surroundings.

use glam::DVec3;

use crate::{shape::BodyShape, sky::Sky};

/// A distant lamp: a disc of directions.
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

/// A scene to render.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The body; it fills the unit sphere.
    pub shape: BodyShape,
    /// The lamps.
    pub lamps: Vec<Lamp>,
    /// Stokes vector of their light; its first component is 1.
    pub light: [f64; 4],
    /// The basis of that vector.
    pub light_basis: LampBasis,
    /// The surroundings.
    pub sky: Sky,
    /// Add one reflection between points of the body.
    pub bounce: bool,
    /// Columns and rows.
    pub size: [usize; 2],
    /// Samples per pixel.
    pub samples: usize,
    /// Evaluate the model for every sample.
    pub exact: bool,
    /// Keep spectra in the film; implies `exact`.
    pub spectra: bool,
}
