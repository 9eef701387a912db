//! Evaluates a material at the nodes of a table.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;
use mist_engine::{Control, material::MaterialError};
use rayon::prelude::*;
use spectra::{
    Adaptation, ColourPlan, ColourSettings, Extrapolation, Grid, Illuminant, Observer, Quantity,
    RgbSpace,
};

use super::{
    super::axes::lifted,
    nodes::linear,
    size::{BsdfChannels, BsdfSize},
};
use crate::{
    export::{Bands, ExportError},
    tensor::{NumberType, TensorField},
};

/// Nodes of the density of normals.
const NDF_NODES: usize = 256;
/// The smallest density of normals relative to the largest.
const NDF_FLOOR: f64 = 1e-3;
/// The lower limit, above the horizon, of the density from which readers sample.
const LUMINANCE_FLOOR: f64 = 1e-4;
/// Polar angle of the lowest viewer, degrees.
pub(super) const LAST_THETA: f64 = 88.0;
/// Replaces θ = 0, where directions have no azimuth; radians.
pub(super) const OFF_AXIS: f64 = 1e-4;

/// The images of one viewer.
pub(super) struct ViewerImages {
    /// `[channel, y, x]`.
    pub(super) values: Vec<f32>,
    /// `[y, x]`.
    pub(super) luminance: Vec<f32>,
}

/// A pair of directions with its half vector.
pub(super) struct BsdfNode {
    pub(super) to_viewer: DVec3,
    pub(super) to_light: DVec3,
    /// The half vector.
    m: DVec3,
    /// The coordinate of the half vector's polar angle.
    pub(super) u: f64,
}

impl BsdfNode {
    /// dω of the light per area of the unit square.
    pub(super) fn solid_angle(&self) -> f64 {
        let sin = self.m.x.hypot(self.m.y);
        2.0 * PI * PI * self.u * sin * 4.0 * self.to_viewer.dot(self.m).max(0.0)
    }
}

/// A material with the nodes of its table.
pub(super) struct BsdfSampler<'a> {
    bands: &'a Bands,
    pub(super) size: BsdfSize,
    /// Colours of spectra, for RGB.
    plan: Option<ColourPlan>,
    pub(super) thetas: Vec<f64>,
    pub(super) phis: Vec<f64>,
    pub(super) ndf: Vec<f32>,
}

impl<'a> BsdfSampler<'a> {
    pub(super) fn new(
        bands: &'a Bands,
        channels: BsdfChannels,
        size: BsdfSize,
    ) -> Result<Self, ExportError> {
        if size.phi_i == 1 && !bands.is_isotropic() {
            let problem = "the matrices change when the sample is rotated: give the azimuths of the \
                           viewer too, such as 37x20x48";
            return Err(ExportError::refused("grid", problem));
        }
        let part = |i: usize, n: usize| i as f64 / (n.max(2) - 1) as f64;
        let theta = |i| LAST_THETA.to_radians() * f64::powf(part(i, size.theta_i), 0.8);
        let phi = |i| if size.phi_i == 1 { 0.0 } else { TAU * part(i, size.phi_i) - PI };
        let plan = match channels {
            BsdfChannels::Spectra => None,
            BsdfChannels::Rgb => Some(srgb(bands.nm())?),
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

    pub(super) fn fields(&self, description: &str) -> Vec<TensorField> {
        let BsdfSize { phi_i, theta_i, side } = self.size;
        let waves = self.bands.nm().len();
        let mut fields = vec![
            TensorField::new("description", NumberType::U8, &[description.len()]),
            TensorField::new("jacobian", NumberType::U8, &[1]),
            TensorField::new("theta_i", NumberType::F32, &[theta_i]),
            TensorField::new("phi_i", NumberType::F32, &[phi_i]),
            TensorField::new("ndf", NumberType::F32, &[2, NDF_NODES]),
            TensorField::new("sigma", NumberType::F32, &[2, 2]),
            TensorField::new("vndf", NumberType::F32, &[phi_i, theta_i, 2, 2]),
        ];
        if self.plan.is_some() {
            fields.push(TensorField::new("rgb", NumberType::F32, &[phi_i, theta_i, 3, side, side]));
        } else {
            fields.push(TensorField::new("wavelengths", NumberType::F32, &[waves]));
            fields.push(TensorField::new(
                "spectra",
                NumberType::F32,
                &[phi_i, theta_i, waves, side, side],
            ));
        }
        fields.push(TensorField::new("luminance", NumberType::F32, &[phi_i, theta_i, side, side]));
        fields
    }

    /// The images of the viewer at `[phi, theta]`.
    pub(super) fn images(
        &self,
        [phi, theta]: [usize; 2],
        control: &Control,
    ) -> Result<ViewerImages, ExportError> {
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
                let spectrum = self.spectrum(&node)?;
                let at = y * side + x;
                let scale = 4.0 / f64::from(linear(&self.ndf, node.u));
                for (k, value) in self.colours(&spectrum).enumerate() {
                    values[k * pixels + at] = (value * scale) as f32;
                }
                if node.to_light.z > 0.0 {
                    let mean = spectrum.iter().sum::<f64>() / spectrum.len() as f64;
                    luminance[at] = (mean * node.solid_angle() + LUMINANCE_FLOOR) as f32;
                }
            }
        }
        Ok(ViewerImages { values, luminance })
    }

    pub(super) fn node(&self, [phi, theta, y, x]: [usize; 4]) -> BsdfNode {
        let [u, w] = [x, y].map(|i| i as f64 / (self.size.side - 1) as f64);
        self.at(self.thetas[theta], self.phis[phi], u, w)
    }

    /// The viewer at `theta` and `phi`, and the half vector at (u, w) of its image.
    pub(super) fn at(&self, theta: f64, phi: f64, u: f64, w: f64) -> BsdfNode {
        let to_viewer = direction(theta.max(OFF_AXIS), phi);
        let offset = if self.size.phi_i == 1 { phi } else { 0.0 };
        let m = direction((FRAC_PI_2 * u * u).max(OFF_AXIS), (2.0 * w - 1.0) * PI + offset);
        BsdfNode { to_viewer, m, to_light: 2.0 * to_viewer.dot(m) * m - to_viewer, u }
    }

    /// f cos θ of the light at every wavelength.
    pub(super) fn spectrum(&self, node: &BsdfNode) -> Result<Vec<f64>, ExportError> {
        let (light, viewer) = (lifted(node.to_light), lifted(node.to_viewer));
        let spectrum: Vec<f64> =
            self.bands.unpolarized(light, viewer).map(|f| f * light.z).collect();
        match spectrum.iter().position(|f| !f.is_finite()) {
            Some(bad) => Err(not_finite(light, viewer, self.bands.nm()[bad])),
            None => Ok(spectrum),
        }
    }

    pub(super) fn colours<'s>(&self, spectrum: &'s [f64]) -> Box<dyn Iterator<Item = f64> + 's> {
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
        ExportError::refused("wavelengths", format!("they give no colours: {error}"))
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

/// A density of normals over x: the retro-reflected light times the cosine.
fn density_of_normals(bands: &Bands) -> Vec<f32> {
    let back = |i: usize| {
        let u = i as f64 / (NDF_NODES - 1) as f64;
        let m = lifted(direction((FRAC_PI_2 * u * u).max(OFF_AXIS), 0.0));
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
