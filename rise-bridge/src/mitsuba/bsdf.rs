//! `.bsdf`: the reflection for unpolarized light in the format of the RGL, for Mitsuba's
//! `measured` and every other reader of it; spectra or linear sRGB.
//!
//! A tensor file with one image over the half vector m per direction of the viewer (θ_i, φ_i). The
//! unit square is x = √(2θ_m/π), y = (φ_m − φ_i + π)/2π, and without rotational symmetry
//! y = (φ_m + π)/2π. A reader takes
//!
//! $$ f \cos\theta_o = \frac{\mathrm{spectra}(x, y)\,\mathrm{ndf}(x, y)}{4\,\sigma} $$
//!
//! where (x, y) is first warped by the density of visible normals `vndf`. We write the identity for
//! it (ones) and for σ, a smooth `ndf` that takes the peak out of the images, and a `luminance` from
//! which readers sample directions.
//!
//! J. Dupuy and W. Jakob, *An Adaptive Parameterization for Efficient Material Acquisition and
//! Rendering*, ACM Trans. Graph. 37(6), 274 (2018).

mod spread;
mod table;

use std::{
    f64::consts::{FRAC_PI_2, PI, TAU},
    io::Write,
    sync::atomic::{AtomicUsize, Ordering},
};

use glam::DVec3;
use mist_engine::{Control, material::MaterialError};
use rayon::prelude::*;
use spectra::{
    Adaptation, ColourPlan, ColourSettings, Extrapolation, Grid, Illuminant, Observer, Quantity,
    RgbSpace,
};

pub use spread::{choose_size, spread};
pub use table::Table;

use super::axes::lifted;
use crate::{
    export::{Bands, ExportError},
    tensor::{Field, Kind, Writer},
};

/// Nodes of the density of normals.
const NDF_NODES: usize = 256;
/// The least density of normals, as a part of the largest.
const NDF_FLOOR: f64 = 1e-3;
/// The density from which readers sample is at least this above the horizon.
const LUMINANCE_FLOOR: f64 = 1e-4;
/// The lowest viewer.
const LAST_THETA: f64 = 88.0;
/// In the place of θ = 0, where directions lose their azimuth; radians.
const AWAY: f64 = 1e-4;

/// Viewers and pixels of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Azimuths of the viewer: 1 for isotropic materials.
    pub phi_i: usize,
    /// Polar angles of the viewer.
    pub theta_i: usize,
    /// Pixels of an image on each side.
    pub side: usize,
}

impl Size {
    /// From `24x64` (θ_i, side) or `37x20x48` (φ_i, θ_i, side).
    ///
    /// # Errors
    ///
    /// For other texts, and axes that are too short or absurdly long.
    pub fn parse(text: &str) -> Result<Self, ExportError> {
        let refused = || {
            let problem = format!(
                "{text:?}: expected theta_i x side of the image, such as 24x64, or \
                 phi_i x theta_i x side, such as 37x20x48; at least 2 theta_i and 4 pixels"
            );
            ExportError::refused("grid", problem)
        };
        let numbers: Result<Vec<usize>, _> = text.split('x').map(str::parse).collect();
        let size = match numbers.as_deref() {
            Ok(&[theta_i, side]) => Self { phi_i: 1, theta_i, side },
            Ok(&[phi_i, theta_i, side]) => Self { phi_i, theta_i, side },
            _ => return Err(refused()),
        };
        let phi_good = size.phi_i == 1 || (4..=1024).contains(&size.phi_i);
        let good =
            phi_good && (2..=1024).contains(&size.theta_i) && (4..=4096).contains(&size.side);
        good.then_some(size).ok_or_else(refused)
    }
}

/// What the images hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channels {
    /// One image per wavelength.
    Spectra,
    /// Three images: linear sRGB under D65, for the observer of 1931; not below 0.
    Rgb,
}

/// Writes the table of `bands`; `description` goes along as a field of its own.
///
/// # Errors
///
/// For an anisotropic material with one azimuth, models that are not finite somewhere, a wish to
/// stop, and an `out` that does not take the data.
pub fn write<W: Write>(
    bands: &Bands,
    channels: Channels,
    size: Size,
    description: &str,
    out: W,
    control: &Control,
) -> Result<W, ExportError> {
    let job = Job::new(bands, channels, size)?;
    let mut file = Writer::begin(out, job.fields(description))?;
    file.bytes(description.as_bytes())?;
    file.bytes(&[1])?;
    file.f32s(job.thetas.iter().map(|x| *x as f32))?;
    file.f32s(job.phis.iter().map(|x| *x as f32))?;
    // The same for every azimuth: two rows.
    file.f32s(job.ndf.iter().chain(&job.ndf).copied())?;
    file.f32s([1.0; 4])?;
    file.f32s(std::iter::repeat_n(1.0, size.phi_i * size.theta_i * 4))?;
    if channels == Channels::Spectra {
        file.f32s(bands.nm().iter().map(|nm| *nm as f32))?;
    }
    let viewers = size.phi_i * size.theta_i;
    let (mut luminance, done) = (Vec::new(), AtomicUsize::new(0));
    let step = rayon::current_num_threads().max(1);
    for first in (0..viewers).step_by(step) {
        let images: Result<Vec<Images>, ExportError> = (first..(first + step).min(viewers))
            .into_par_iter()
            .map(|at| {
                let images = job.images([at / size.theta_i, at % size.theta_i], control)?;
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                control.report(done as f64 / viewers as f64);
                Ok(images)
            })
            .collect();
        for images in images? {
            file.f32s(images.values)?;
            luminance.extend(images.luminance);
        }
    }
    file.f32s(luminance)?;
    Ok(file.finish()?)
}

/// What one viewer sees.
struct Images {
    /// `[channel, y, x]`.
    values: Vec<f32>,
    /// `[y, x]`.
    luminance: Vec<f32>,
}

/// A pair of directions by the viewer and the half vector.
struct Node {
    to_viewer: DVec3,
    to_light: DVec3,
    m: DVec3,
    /// The coordinate of the half vector's polar angle.
    u: f64,
}

impl Node {
    /// dω of the light per area of the unit square.
    fn solid_angle(&self) -> f64 {
        let sin = self.m.x.hypot(self.m.y);
        2.0 * PI * PI * self.u * sin * 4.0 * self.to_viewer.dot(self.m).max(0.0)
    }
}

struct Job<'a> {
    bands: &'a Bands,
    size: Size,
    /// Colours of spectra, for RGB.
    plan: Option<ColourPlan>,
    thetas: Vec<f64>,
    phis: Vec<f64>,
    ndf: Vec<f32>,
}

impl<'a> Job<'a> {
    fn new(bands: &'a Bands, channels: Channels, size: Size) -> Result<Self, ExportError> {
        if size.phi_i == 1 && !bands.is_isotropic() {
            let problem = "the matrices change when the sample is turned: give the azimuths of the \
                           viewer too, such as 37x20x48";
            return Err(ExportError::refused("grid", problem));
        }
        let part = |i: usize, n: usize| i as f64 / (n.max(2) - 1) as f64;
        let theta = |i| LAST_THETA.to_radians() * f64::powf(part(i, size.theta_i), 0.8);
        let phi = |i| if size.phi_i == 1 { 0.0 } else { TAU * part(i, size.phi_i) - PI };
        let plan = match channels {
            Channels::Spectra => None,
            Channels::Rgb => Some(srgb(bands.nm())?),
        };
        Ok(Self {
            bands,
            size,
            plan,
            thetas: (0..size.theta_i).map(theta).collect(),
            phis: (0..size.phi_i).map(phi).collect(),
            ndf: density_of_normals(bands),
        })
    }

    fn channels(&self) -> usize {
        if self.plan.is_some() { 3 } else { self.bands.nm().len() }
    }

    fn fields(&self, description: &str) -> Vec<Field> {
        let Size { phi_i, theta_i, side } = self.size;
        let waves = self.bands.nm().len();
        let mut fields = vec![
            Field::new("description", Kind::U8, &[description.len()]),
            Field::new("jacobian", Kind::U8, &[1]),
            Field::new("theta_i", Kind::F32, &[theta_i]),
            Field::new("phi_i", Kind::F32, &[phi_i]),
            Field::new("ndf", Kind::F32, &[2, NDF_NODES]),
            Field::new("sigma", Kind::F32, &[2, 2]),
            Field::new("vndf", Kind::F32, &[phi_i, theta_i, 2, 2]),
        ];
        if self.plan.is_some() {
            fields.push(Field::new("rgb", Kind::F32, &[phi_i, theta_i, 3, side, side]));
        } else {
            fields.push(Field::new("wavelengths", Kind::F32, &[waves]));
            fields.push(Field::new("spectra", Kind::F32, &[phi_i, theta_i, waves, side, side]));
        }
        fields.push(Field::new("luminance", Kind::F32, &[phi_i, theta_i, side, side]));
        fields
    }

    /// What the viewer at `[phi, theta]` sees.
    fn images(&self, [phi, theta]: [usize; 2], control: &Control) -> Result<Images, ExportError> {
        let side = self.size.side;
        let pixels = side * side;
        let mut values = vec![0.0; self.channels() * pixels];
        let mut luminance = vec![0.0; pixels];
        for y in 0..side {
            if control.is_cancelled() {
                return Err(ExportError::Cancelled);
            }
            for x in 0..side {
                let node = self.node([phi, theta, y, x]);
                let spectrum = self.seen(&node)?;
                let at = y * side + x;
                let scale = 4.0 / f64::from(table::linear(&self.ndf, node.u));
                for (k, value) in self.colours(&spectrum).enumerate() {
                    values[k * pixels + at] = (value * scale) as f32;
                }
                if node.to_light.z > 0.0 {
                    let mean = spectrum.iter().sum::<f64>() / spectrum.len() as f64;
                    luminance[at] = (mean * node.solid_angle() + LUMINANCE_FLOOR) as f32;
                }
            }
        }
        Ok(Images { values, luminance })
    }

    fn node(&self, [phi, theta, y, x]: [usize; 4]) -> Node {
        let [u, w] = [x, y].map(|i| i as f64 / (self.size.side - 1) as f64);
        self.at(self.thetas[theta], self.phis[phi], u, w)
    }

    /// The viewer at `theta` and `phi`, and the half vector at (u, w) of its image.
    fn at(&self, theta: f64, phi: f64, u: f64, w: f64) -> Node {
        let to_viewer = direction(theta.max(AWAY), phi);
        let turned = if self.size.phi_i == 1 { phi } else { 0.0 };
        let m = direction((FRAC_PI_2 * u * u).max(AWAY), (2.0 * w - 1.0) * PI + turned);
        Node { to_viewer, m, to_light: 2.0 * to_viewer.dot(m) * m - to_viewer, u }
    }

    /// f cos θ of the light at every wavelength.
    fn seen(&self, node: &Node) -> Result<Vec<f64>, ExportError> {
        let (asked, seen) = (lifted(node.to_light), lifted(node.to_viewer));
        let spectrum: Vec<f64> = self.bands.unpolarized(asked, seen).map(|f| f * asked.z).collect();
        match spectrum.iter().position(|f| !f.is_finite()) {
            Some(bad) => Err(not_finite(asked, seen, self.bands.nm()[bad])),
            None => Ok(spectrum),
        }
    }

    fn colours<'s>(&self, spectrum: &'s [f64]) -> Box<dyn Iterator<Item = f64> + 's> {
        match &self.plan {
            None => Box::new(spectrum.iter().copied()),
            Some(plan) => {
                Box::new(plan.rgb(plan.unpolarized(spectrum)).into_iter().map(|x| x.max(0.0)))
            }
        }
    }
}

/// Linear sRGB of a BRDF under D65, equal to the BRDF for a grey one.
fn srgb(nm: &[f64]) -> Result<ColourPlan, ExportError> {
    let refused = |error: &dyn std::fmt::Display| {
        ExportError::refused("wavelengths", format!("no colours come of them: {error}"))
    };
    let grid = Grid::new(nm).map_err(|error| refused(&error))?;
    let settings = ColourSettings {
        quantity: Quantity::Brdf,
        illuminant: Illuminant::parse("D65").map_err(|error| refused(&error))?,
        observer: Observer::parse("CIE1931_2").map_err(|error| refused(&error))?,
        space: RgbSpace::parse("sRGB").map_err(|error| refused(&error))?,
        adaptation: Adaptation::parse("Bradford").map_err(|error| refused(&error))?,
        filters: Vec::new(),
        outside: Extrapolation::Hold,
    };
    ColourPlan::new(&grid, settings).map_err(|error| refused(&error))
}

/// A density of normals over x: the light that comes straight back, times the cosine.
fn density_of_normals(bands: &Bands) -> Vec<f32> {
    let back = |i: usize| {
        let u = i as f64 / (NDF_NODES - 1) as f64;
        let m = lifted(direction((FRAC_PI_2 * u * u).max(AWAY), 0.0));
        let sum: f64 = bands.unpolarized(m, m).sum();
        if sum.is_finite() { sum.max(0.0) * m.z / bands.nm().len() as f64 } else { 0.0 }
    };
    let back: Vec<f64> = (0..NDF_NODES).into_par_iter().map(back).collect();
    let most = back.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    back.iter().map(|x| (x / most + NDF_FLOOR) as f32).collect()
}

fn direction(theta: f64, phi: f64) -> DVec3 {
    let ((sin, cos), (sin_phi, cos_phi)) = (theta.sin_cos(), phi.sin_cos());
    DVec3::new(sin * cos_phi, sin * sin_phi, cos)
}

fn not_finite(l: DVec3, v: DVec3, nm: f64) -> ExportError {
    MaterialError::NotFinite(format!("light from {l:.3}, viewer at {v:.3}, {nm} nm")).into()
}
