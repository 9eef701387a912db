//! A `.bsdf` in memory, and its values as readers interpolate them.

use std::{
    f64::consts::{FRAC_PI_2, PI, TAU},
    io::{Read, Seek},
};

use glam::DVec3;

use crate::tensor::{Reader, TensorError};

/// A table with the identity in the place of visible normals, as we write it.
#[derive(Clone, Debug)]
pub struct Table {
    theta_i: Vec<f64>,
    phi_i: Vec<f64>,
    ndf: Vec<f32>,
    /// nm; empty for RGB.
    wavelengths: Vec<f64>,
    /// `[phi_i, theta_i, channel, y, x]`.
    values: Vec<f32>,
    channels: usize,
    side: usize,
}

impl Table {
    /// Reads a whole table.
    ///
    /// # Errors
    ///
    /// For files that are no `.bsdf`, and for those that warp the half vector.
    pub fn read<R: Read + Seek>(source: R) -> Result<Self, TensorError> {
        let mut file = Reader::open(source)?;
        let spectral = file.fields().iter().any(|field| field.name == "spectra");
        let name = if spectral { "spectra" } else { "rgb" };
        let (theta_i, phi_i) = (file.numbers("theta_i")?, file.numbers("phi_i")?);
        let wavelengths = if spectral { file.numbers("wavelengths")? } else { Vec::new() };
        let shape = file.field(name)?.shape.clone();
        let channels = if spectral { wavelengths.len() } else { 3 };
        let wanted = [phi_i.len() as u64, theta_i.len() as u64, channels as u64];
        let [.., height, width] = shape[..] else {
            return Err(TensorError::field(name, "expected five dimensions"));
        };
        if shape[..shape.len() - 2] != wanted || height != width || width < 2 {
            let problem =
                format!("its shape is {shape:?}, but the axes say {wanted:?} and a square");
            return Err(TensorError::field(name, problem));
        }
        for name in ["vndf", "sigma"] {
            if file.numbers(name)?.iter().any(|x| *x != 1.0) {
                let problem = "only tables with the identity (ones) in it are read";
                return Err(TensorError::field(name, problem));
            }
        }
        let ndf_shape = file.field("ndf")?.shape.clone();
        let [_, nodes] = ndf_shape[..] else {
            return Err(TensorError::field("ndf", "expected two dimensions"));
        };
        let ndf = file.f32s("ndf", 0, nodes)?;
        let count = file.field(name)?.len().unwrap_or_default();
        let values = file.f32s(name, 0, count)?;
        Ok(Self { theta_i, phi_i, ndf, wavelengths, values, channels, side: width as usize })
    }

    /// Its wavelengths, nm; none if it holds linear sRGB.
    pub fn wavelengths(&self) -> &[f64] {
        &self.wavelengths
    }

    /// f cos θ of the light (1/sr) in every channel, for unit vectors away from the surface; zero
    /// below the horizon.
    pub fn eval(&self, to_light: DVec3, to_viewer: DVec3) -> Vec<f64> {
        let mut all = vec![0.0; self.channels];
        let grid = Grid { theta_i: &self.theta_i, phi_i: &self.phi_i, side: self.side };
        let Some((u, nodes)) = grid.around(to_light, to_viewer) else { return all };
        let scale = f64::from(linear(&self.ndf, u)) / 4.0;
        for ([p, t, y, x], weight) in nodes {
            for (channel, sum) in all.iter_mut().enumerate() {
                let image = (p * self.theta_i.len() + t) * self.channels + channel;
                let at = (image * self.side + y) * self.side + x;
                *sum += weight * scale * f64::from(self.values[at]);
            }
        }
        all
    }
}

/// Where the nodes of a table are: viewers, and pixels on each side of an image.
pub(super) struct Grid<'a> {
    pub(super) theta_i: &'a [f64],
    pub(super) phi_i: &'a [f64],
    pub(super) side: usize,
}

impl Grid<'_> {
    /// The coordinate of the half vector's polar angle, and the nodes (φ_i, θ_i, y, x) around a pair
    /// of directions with their weights; nothing below the horizon.
    pub(super) fn around(
        &self,
        to_light: DVec3,
        to_viewer: DVec3,
    ) -> Option<(f64, impl Iterator<Item = ([usize; 4], f64)> + use<>)> {
        let m = (to_light + to_viewer).try_normalize()?;
        if to_light.z <= 0.0 || to_viewer.z <= 0.0 {
            return None;
        }
        let polar = |w: DVec3| w.x.hypot(w.y).atan2(w.z);
        let (phi_i, phi_m) = (to_viewer.y.atan2(to_viewer.x), m.y.atan2(m.x));
        let turned = if self.phi_i.len() == 1 { phi_m - phi_i } else { phi_m };
        let u = (polar(m) / FRAC_PI_2).sqrt();
        let w = ((turned + PI) / TAU).rem_euclid(1.0);
        let last = (self.side - 1) as f64;
        let pixel = |x: f64| {
            let at = (x * last).clamp(0.0, last);
            let low = (at as usize).min(self.side - 2);
            (low, low + 1, at - low as f64)
        };
        let axes =
            [place(self.phi_i, phi_i), place(self.theta_i, polar(to_viewer)), pixel(w), pixel(u)];
        let node = move |bits: usize| {
            let picked: [(usize, f64); 4] = std::array::from_fn(|k| {
                let (low, high, part) = axes[k];
                if bits >> k & 1 == 1 { (high, part) } else { (low, 1.0 - part) }
            });
            (picked.map(|side| side.0), picked.iter().map(|side| side.1).product::<f64>())
        };
        Some((u, (0..16).map(node).filter(|(_, weight)| *weight > 0.0)))
    }
}

/// The node below `x`, the one above, and how far it is between them; held at the ends.
fn place(nodes: &[f64], x: f64) -> (usize, usize, f64) {
    if nodes.len() < 2 {
        return (0, 0, 0.0);
    }
    let high = nodes.partition_point(|node| *node < x).clamp(1, nodes.len() - 1);
    let part = (x - nodes[high - 1]) / (nodes[high] - nodes[high - 1]);
    (high - 1, high, part.clamp(0.0, 1.0))
}

/// The value of evenly spaced `nodes` at `x` in 0 … 1.
pub(super) fn linear(nodes: &[f32], x: f64) -> f32 {
    let at = x.clamp(0.0, 1.0) * (nodes.len() - 1) as f64;
    let low = (at as usize).min(nodes.len().saturating_sub(2));
    let part = (at - low as f64) as f32;
    let high = (low + 1).min(nodes.len() - 1);
    nodes[low] * (1.0 - part) + nodes[high] * part
}
