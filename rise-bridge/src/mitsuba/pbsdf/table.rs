//! A `.pbsdf` in memory, and its values as Mitsuba interpolates them.

use std::io::{Read, Seek};

use glam::DVec3;
use scattering::Mueller;

use super::super::frame::{HalfAngles, from_table};
use crate::tensor::{Reader, TensorError};

/// A table with its axes.
#[derive(Clone, Debug)]
pub struct Table {
    pub(super) head: Head,
    m: Vec<f32>,
}

/// The axes of a file, checked; its matrices are read in pieces.
#[derive(Clone, Debug)]
pub(super) struct Head {
    /// φ_d, θ_d, θ_h in radians, then nm.
    pub(super) axes: [Vec<f64>; 4],
}

impl Head {
    pub(super) fn read<R: Read + Seek>(file: &mut Reader<R>) -> Result<Self, TensorError> {
        let mut axis = |name: &str| {
            let nodes = file.numbers(name)?;
            let rising = nodes.windows(2).all(|pair| pair[0] < pair[1]);
            if nodes.is_empty() || !rising || nodes.iter().any(|x| !x.is_finite()) {
                return Err(TensorError::field(name, "expected rising nodes"));
            }
            Ok(nodes)
        };
        let axes = [axis("phi_d")?, axis("theta_d")?, axis("theta_h")?, axis("wvls")?];
        let wanted = axes.iter().map(|nodes| nodes.len() as u64).chain([4, 4]);
        let (wanted, found): (Vec<u64>, _) = (wanted.collect(), &file.field("M")?.shape);
        if wanted != *found {
            let problem = format!("its shape is {found:?}, but the axes say {wanted:?}");
            return Err(TensorError::field("M", problem));
        }
        Ok(Self { axes })
    }

    /// Numbers of all θ_h and wavelengths at one φ_d and θ_d.
    pub(super) fn row(&self) -> usize {
        self.axes[2].len() * self.axes[3].len() * 16
    }
}

impl Table {
    /// Reads a whole table.
    ///
    /// # Errors
    ///
    /// For files that are no `.pbsdf`.
    pub fn read<R: Read + Seek>(source: R) -> Result<Self, TensorError> {
        let mut file = Reader::open(source)?;
        let head = Head::read(&mut file)?;
        let count = file.field("M")?.len().unwrap_or_default();
        Ok(Self { m: file.f32s("M", 0, count)?, head })
    }

    /// Nodes of φ_d, θ_d, θ_h (radians) and of the wavelength (nm).
    pub fn axes(&self) -> &[Vec<f64>; 4] {
        &self.head.axes
    }

    /// The matrix (1/sr, no cosine) at a node, in the frame of the table.
    pub fn node(&self, [i, j, k, w]: [usize; 4]) -> Mueller {
        let [_, n_d, n_h, n_w] = self.head.axes.each_ref().map(Vec::len);
        let at = (((i * n_d + j) * n_h + k) * n_w + w) * 16;
        Mueller::from_row_major(std::array::from_fn(|e| self.m[at + e].into()))
    }

    /// The matrix between the nodes, linear along every axis and held beyond its ends.
    pub fn interpolated(&self, at: &HalfAngles, nm: f64) -> Mueller {
        let wanted = [at.phi_d, at.theta_d, at.theta_h, nm];
        let places: [Place; 4] =
            std::array::from_fn(|axis| Place::of(wanted[axis], &self.head.axes[axis]));
        corners(places).fold(Mueller::ZERO, |sum, (node, weight)| sum + self.node(node) * weight)
    }

    /// What Mitsuba's `eval` gives at `nm` for light from `to_light` towards `to_viewer`: the
    /// matrix between its Stokes bases, times the cosine of the light; zero below the horizon
    /// and, as in Mitsuba, for exact mirror images.
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

/// A place on an axis: the node below, the one above, and how far it is between them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    low: usize,
    high: usize,
    part: f64,
}

impl Place {
    pub(super) fn of<T: Copy + Into<f64>>(x: f64, nodes: &[T]) -> Self {
        let high =
            nodes.partition_point(|node| (*node).into() < x).clamp(1, nodes.len().max(2) - 1);
        let (low, high) = (high - 1, high.min(nodes.len() - 1));
        let (a, b): (f64, f64) = (nodes[low].into(), nodes[high].into());
        let part = if b > a { ((x - a) / (b - a)).clamp(0.0, 1.0) } else { 0.0 };
        Self { low, high, part }
    }
}

/// The nodes around a place with their weights; those that do not count are left out, so that a
/// node is met exactly.
pub(super) fn corners<const N: usize>(
    places: [Place; N],
) -> impl Iterator<Item = ([usize; N], f64)> {
    (0..1_usize << N).filter_map(move |bits| {
        let upper = |axis: usize| bits >> axis & 1 == 1;
        let weight = (0..N)
            .map(|axis| if upper(axis) { places[axis].part } else { 1.0 - places[axis].part })
            .product::<f64>();
        let node = std::array::from_fn(|axis| match upper(axis) {
            true => places[axis].high,
            false => places[axis].low,
        });
        (weight > 0.0).then_some((node, weight))
    })
}
