//! Pixels of a unit cell, and the parameters of the gratings drawn on them.

use super::lattice::{Lattice, lean};
use crate::{
    grating::{GratingMaterial, positive},
    rcw::toeplitz::FourierSeries,
    spec::{Parameter, ParameterError, ParameterNode},
};
use num_complex::Complex64;

/// The unit cell and its pixels: the second group of every gridded crossed grating.
pub(super) const CELL: &[Parameter] = &[
    Parameter::number("zeta", 0.0, "deg", "Angle from y to axis 2"),
    Parameter::number("d1", 0.5, "um", "Period along axis 1"),
    Parameter::number("d2", 0.5, "um", "Period along axis 2"),
    Parameter::integer("grid1", 1024, "Pixels along axis 1"),
    Parameter::integer("grid2", 1024, "Pixels along axis 2"),
];

/// Most pixels along an axis.
const MOST_PIXELS: i32 = 8192;

/// A unit cell to be divided into pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct UnitCell {
    /// Periods.
    pub(super) lattice: Lattice,
    /// Pixels along both axes.
    pub(super) pixels: [usize; 2],
}

impl UnitCell {
    /// Reads the parameters of [`CELL`].
    ///
    /// # Errors
    ///
    /// For periods that are not positive, axes that coincide, or a number of pixels outside
    /// 1 to 8192.
    pub(super) fn read(node: &ParameterNode) -> Result<Self, ParameterError> {
        let pixels = |name: &str| -> Result<usize, ParameterError> {
            let n = node.integer(name);
            if (1..=MOST_PIXELS).contains(&n) {
                return Ok(n.unsigned_abs() as usize);
            }
            Err(ParameterError::new(name, format!("{n} is not from 1 to {MOST_PIXELS}")))
        };
        Ok(Self {
            lattice: Lattice {
                d1: positive(node, "d1")?,
                d2: positive(node, "d2")?,
                zeta: lean(node, "zeta")?,
            },
            pixels: [pixels("grid1")?, pixels("grid2")?],
        })
    }

    /// The cell painted with `materials`; `which` chooses one at the centre (x, y) of a pixel.
    pub(super) fn paint(
        &self,
        materials: Vec<GratingMaterial>,
        which: impl Fn(f64, f64) -> u8,
    ) -> PixelGrid {
        let [n1, n2] = self.pixels;
        let (sin, cos) = self.lattice.zeta.sin_cos();
        let place = |i: usize, n: usize, d: f64| ((i as f64 + 0.5) / n as f64 - 0.5) * d;
        let mut cells = Vec::with_capacity(n1 * n2);
        for j in 0..n2 {
            let x2 = place(j, n2, self.lattice.d2);
            for i in 0..n1 {
                let x1 = place(i, n1, self.lattice.d1);
                cells.push(which(x1 + x2 * sin, x2 * cos));
            }
        }
        PixelGrid { pixels: self.pixels, cells, materials }
    }
}

/// A unit cell of pixels.
#[derive(Clone, Debug)]
pub struct PixelGrid {
    pixels: [usize; 2],
    /// Material of every pixel, axis 1 running fastest.
    cells: Vec<u8>,
    /// The materials.
    pub(super) materials: Vec<GratingMaterial>,
}

/// Lines of pixels that look alike.
pub(super) struct PixelLines {
    /// One of each look.
    looks: Vec<Vec<u8>>,
    /// Per look, the series along the other axis of where it stands.
    pub(super) where_: Vec<FourierSeries>,
}

impl PixelGrid {
    /// The lines along `axis` (0 or 1), with series up to `most` along the other axis.
    pub(super) fn lines(&self, axis: usize, most: usize) -> PixelLines {
        let [n1, n2] = self.pixels;
        let line = |k: usize| -> Vec<u8> {
            if axis == 0 {
                self.cells[k * n1..(k + 1) * n1].to_vec()
            } else {
                (0..n2).map(|j| self.cells[j * n1 + k]).collect()
            }
        };
        let count = self.pixels[1 - axis];
        let mut looks: Vec<Vec<u8>> = Vec::new();
        let mut known = std::collections::BTreeMap::new();
        let mut places = Vec::with_capacity(count);
        for k in 0..count {
            let line = line(k);
            let look = *known.entry(line.clone()).or_insert_with(|| {
                looks.push(line);
                looks.len() - 1
            });
            places.push(look);
        }
        let where_ = (0..looks.len())
            .map(|look| transform(&places, most, |&at| f64::from(u8::from(at == look)).into()))
            .collect();
        PixelLines { looks, where_ }
    }
}

impl PixelLines {
    /// The series along the line of each look of a function of the material.
    pub(super) fn series(&self, values: &[Complex64], most: usize) -> Vec<FourierSeries> {
        self.looks.iter().map(|look| transform(look, most, |m| values[usize::from(*m)])).collect()
    }
}

/// Coefficients −`most`…`most` of the samples `of(line)`, the middle of the line at 0.
fn transform<T>(line: &[T], most: usize, of: impl Fn(&T) -> Complex64) -> FourierSeries {
    let n = line.len();
    let turn = std::f64::consts::TAU / n as f64;
    let waves: Vec<Complex64> = (0..n).map(|k| Complex64::cis(-turn * k as f64)).collect();
    let values: Vec<Complex64> = line.iter().map(of).collect();
    let coefficient = |m: isize| -> Complex64 {
        let step = m.rem_euclid(n as isize) as usize;
        let mut at = 0;
        let mut sum = Complex64::ZERO;
        for value in &values {
            sum += value * waves[at];
            at += step;
            if at >= n {
                at -= n;
            }
        }
        // The first pixel's centre lies half a pixel inside the edge at −½.
        let start = 0.5 / n as f64 - 0.5;
        sum * Complex64::cis(-std::f64::consts::TAU * m as f64 * start) / n as f64
    };
    let most = most as isize;
    FourierSeries((-most..=most).map(coefficient).collect())
}
