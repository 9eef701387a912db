//! A `.pbsdf` in memory, interpolated as Mitsuba does.

use std::io::{Read, Seek};

use glam::DVec3;
use scattering::Mueller;

use super::{
    super::frame::{HalfAngles, from_table},
    header::PbsdfHeader,
    nodes::{AxisInterval, corners},
};
use crate::tensor::{TensorError, TensorReader};

/// A table with its axes.
#[derive(Clone, Debug)]
pub struct PbsdfTable {
    header: PbsdfHeader,
    m: Vec<f32>,
}

impl PbsdfTable {
    /// Reads a whole table.
    ///
    /// # Errors
    ///
    /// If the file is not a `.pbsdf`.
    pub fn read<R: Read + Seek>(source: R) -> Result<Self, TensorError> {
        let mut file = TensorReader::open(source)?;
        let header = PbsdfHeader::read(&mut file)?;
        let count = file.field("M")?.len().unwrap_or_default();
        Ok(Self { m: file.f32s("M", 0, count)?, header })
    }

    /// Nodes of φ_d, θ_d, θ_h (radians) and of the wavelength (nm).
    pub fn axes(&self) -> &[Vec<f64>; 4] {
        &self.header.axes
    }

    /// The matrix (1/sr, no cosine) at a node, in the frame of the table.
    pub fn node(&self, [i, j, k, w]: [usize; 4]) -> Mueller {
        let [_, n_d, n_h, n_w] = self.header.axes.each_ref().map(Vec::len);
        let at = (((i * n_d + j) * n_h + k) * n_w + w) * 16;
        Mueller::from_row_major(std::array::from_fn(|e| self.m[at + e].into()))
    }

    /// The matrix at a point, linear along every axis and constant beyond its ends.
    pub fn interpolated(&self, at: &HalfAngles, nm: f64) -> Mueller {
        let point = [at.phi_d, at.theta_d, at.theta_h, nm];
        let intervals: [AxisInterval; 4] =
            std::array::from_fn(|axis| AxisInterval::of(point[axis], &self.header.axes[axis]));
        corners(intervals).fold(Mueller::ZERO, |sum, (node, weight)| sum + self.node(node) * weight)
    }

    /// The value of Mitsuba's `eval` at `nm` for light from `to_light` towards `to_viewer`: the matrix
    /// between its Stokes bases, times the cosine of the light; zero below the horizon and, as in
    /// Mitsuba, for exact mirror directions.
    pub fn eval(&self, to_light: DVec3, to_viewer: DVec3, nm: f64) -> Mueller {
        let above = to_light.z > 0.0 && to_viewer.z > 0.0;
        match HalfAngles::of(to_light, to_viewer) {
            Some(at) if above => {
                from_table(self.interpolated(&at, nm), to_light, to_viewer) * to_light.z
            }
            _ => Mueller::ZERO,
        }
    }
}
