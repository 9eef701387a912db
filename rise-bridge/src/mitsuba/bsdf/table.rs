//! A `.bsdf` in memory, interpolated as readers do.

use std::io::{Read, Seek};

use glam::DVec3;

use super::nodes::{BsdfGrid, linear};
use crate::tensor::{TensorError, TensorReader};

/// A table whose density of visible normals is the identity, as [`write`](fn@super::write) makes it.
#[derive(Clone, Debug)]
pub struct BsdfTable {
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

impl BsdfTable {
    /// Reads a whole table.
    ///
    /// # Errors
    ///
    /// If the file is not a `.bsdf`, or if it warps the half vector.
    pub fn read<R: Read + Seek>(source: R) -> Result<Self, TensorError> {
        let mut file = TensorReader::open(source)?;
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
        let grid = BsdfGrid { theta_i: &self.theta_i, phi_i: &self.phi_i, side: self.side };
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
