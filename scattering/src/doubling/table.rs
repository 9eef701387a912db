//! A diffuse BRDF prepared for any two directions.
//!
//! Elements of mode m are analytic in θ with the parity (−1)^m about the normal. The values at the
//! nodes are carried to an even grid in θ by barycentric interpolation through the nodes and their
//! mirror images, and made exactly reciprocal; between grid points quintics through six points are
//! taken in both angles. The side that is fixed (a beam, a light) is contracted once.
//!
//! J.-P. Berrut and L. N. Trefethen, SIAM Rev. 46, 501 (2004).

use std::f64::consts::FRAC_PI_2;

use super::{block::RealMatrix, diffuse::DiffuseModes};
use crate::Mueller;

/// Rows of the grid beyond the normal.
const BEYOND: usize = 2;
/// Points of an interpolation.
const POINTS: usize = 6;
/// Π (k − j) over the other points j, for every point k of 0 … 5.
const PRODUCTS: [f64; POINTS] = [-120.0, 24.0, -12.0, 12.0, -24.0, 120.0];
/// Most rows of a grid.
const MOST_ROWS: usize = 128;
/// Elements of a matrix.
const ELEMENTS: usize = 16;

/// Modes of a BRDF on an even grid in both angles.
#[derive(Clone, Debug)]
pub struct ModeTable {
    /// Steps from the normal to the horizon.
    steps: usize,
    modes: usize,
    /// f₊, 1/sr; the indices are θ_s, θ_i, mode and element.
    values: Vec<f64>,
}

/// Place of an angle on the grid: neighbouring points with their weights.
#[derive(Clone, Copy, Debug)]
pub struct GridWeights {
    first: usize,
    weights: [f64; POINTS],
}

/// The modes for one incident beam: rows of the grid in θ_s, contracted when asked for.
#[derive(Clone, Debug)]
pub struct BeamModes<'a> {
    table: &'a ModeTable,
    incident: GridWeights,
    /// The contracted rows, in the order in which they were asked for.
    rows: Vec<f64>,
    /// Place of every row of the grid among them, from 1 on; 0 is not contracted.
    places: [u8; MOST_ROWS],
}

impl ModeTable {
    /// The modes of `diffuse` on a grid of `steps` steps, at most 100.
    pub fn new(diffuse: &DiffuseModes, steps: usize) -> Self {
        let steps = steps.clamp(POINTS, MOST_ROWS - BEYOND - 1);
        let (modes, points) = (diffuse.modes.len(), steps + 1 + BEYOND);
        let thetas: Vec<f64> = diffuse.directions.mu.iter().map(|mu| mu.acos()).collect();
        let size = modes * ELEMENTS;
        let mut values = vec![0.0; points * points * size];
        for (m, f) in diffuse.modes.iter().enumerate() {
            let weights = interpolation(&thetas, steps, m);
            let wide = spread(f, &weights);
            for s in 0..points {
                for i in 0..points {
                    let at = (s * points + i) * size + m * ELEMENTS;
                    for e in 0..ELEMENTS {
                        let (a, b) = (e / 4, e % 4);
                        // P = diag(1, 1, −1, 1) on both sides: the reversed path.
                        let sign = if (a == 2) == (b == 2) { 1.0 } else { -1.0 };
                        let reversed = sign * wide[(4 * i + b, 4 * s + a)];
                        values[at + e] = 0.5 * (wide[(4 * s + a, 4 * i + b)] + reversed);
                    }
                }
            }
        }
        Self { steps, modes, values }
    }

    /// The number of modes.
    pub fn modes(&self) -> usize {
        self.modes
    }

    /// Memory that it takes, bytes.
    pub fn bytes(&self) -> usize {
        self.values.len() * size_of::<f64>()
    }

    /// The place of the polar angle `theta` (0 to π/2) on the grid.
    pub fn place(&self, theta: f64) -> GridWeights {
        let x = theta / FRAC_PI_2 * self.steps as f64 + BEYOND as f64;
        let before = POINTS / 2 - 1;
        let last = self.steps + 1 + BEYOND - POINTS;
        let first = (x.floor() as usize).saturating_sub(before).min(last);
        let t = x - first as f64;
        // Lagrange's polynomials: products of the distances to all other points.
        let apart: [f64; POINTS] = std::array::from_fn(|j| t - j as f64);
        let (mut below, mut above) = ([1.0; POINTS], [1.0; POINTS]);
        for k in 1..POINTS {
            below[k] = below[k - 1] * apart[k - 1];
            above[POINTS - 1 - k] = above[POINTS - k] * apart[POINTS - k];
        }
        let weights = std::array::from_fn(|k| below[k] * above[k] / PRODUCTS[k]);
        GridWeights { first, weights }
    }

    /// The modes for a beam with the polar angle `theta`.
    pub fn beam(&self, theta: f64) -> BeamModes<'_> {
        BeamModes {
            table: self,
            incident: self.place(theta),
            rows: Vec::with_capacity(POINTS * self.modes * ELEMENTS),
            places: [0; MOST_ROWS],
        }
    }
}

impl BeamModes<'_> {
    /// The Mueller BRDF towards the polar angle `theta` at the azimuth with this cosine and sine.
    pub fn mueller(&mut self, theta: f64, (cos, sin): (f64, f64)) -> Mueller {
        let GridWeights { first, weights } = self.table.place(theta);
        for row in first..first + POINTS {
            self.contract(row);
        }
        let size = self.table.modes * ELEMENTS;
        let rows: [&[f64]; POINTS] = std::array::from_fn(|k| {
            let at = (usize::from(self.places[first + k]) - 1) * size;
            &self.rows[at..at + size]
        });
        let [even, odd] = pulp::Arch::new().dispatch(
            #[inline(always)]
            || summed(rows, weights, (cos, sin)),
        );
        Mueller(std::array::from_fn(|a| {
            std::array::from_fn(|b| match (a < 2, b < 2) {
                (true, false) => -odd[4 * a + b],
                (false, true) => odd[4 * a + b],
                _ => even[4 * a + b],
            })
        }))
    }

    /// Contracts the row `row` over the angle of incidence.
    fn contract(&mut self, row: usize) {
        if self.places[row] != 0 {
            return;
        }
        let size = self.table.modes * ELEMENTS;
        let points = self.table.steps + 1 + BEYOND;
        let start = self.rows.len();
        self.rows.resize(start + size, 0.0);
        // Fewer rows than MOST_ROWS fit in a byte.
        self.places[row] = (start / size + 1) as u8;
        let at = (row * points + self.incident.first) * size;
        let (values, weights) = (&self.table.values[at..at + POINTS * size], self.incident.weights);
        let out = &mut self.rows[start..];
        pulp::Arch::new().dispatch(
            #[inline(always)]
            || contracted(values, weights, out),
        );
    }
}

/// Σ w v over the points of `values`, one after the other, into `out`.
#[inline(always)]
fn contracted(values: &[f64], weights: [f64; POINTS], out: &mut [f64]) {
    for (values, weight) in values.chunks_exact(out.len()).zip(weights) {
        for (x, value) in out.iter_mut().zip(values) {
            *x += weight * value;
        }
    }
}

/// Sums over modes of Σ w row, times cos mφ and sin mφ, twice for m > 0.
#[inline(always)]
fn summed(
    rows: [&[f64]; POINTS],
    weights: [f64; POINTS],
    (cos, sin): (f64, f64),
) -> [[f64; ELEMENTS]; 2] {
    let rows = rows.map(|row| row.as_chunks::<ELEMENTS>().0);
    let (mut even, mut odd) = ([0.0; ELEMENTS], [0.0; ELEMENTS]);
    let (mut c, mut s) = (1.0, 0.0);
    for m in 0..rows[0].len() {
        let twice = if m == 0 { 1.0 } else { 2.0 };
        let mut f = [0.0; ELEMENTS];
        for (row, weight) in rows.iter().zip(weights) {
            for (x, value) in f.iter_mut().zip(&row[m]) {
                *x += weight * value;
            }
        }
        let (tc, ts) = (twice * c, twice * s);
        for e in 0..ELEMENTS {
            even[e] += f[e] * tc;
            odd[e] += f[e] * ts;
        }
        (c, s) = (c * cos - s * sin, s * cos + c * sin);
    }
    [even, odd]
}

/// The weights of every node (columns) at every grid angle (rows) for the parity of mode `m`.
fn interpolation(thetas: &[f64], steps: usize, m: usize) -> RealMatrix {
    let all: Vec<f64> = thetas.iter().copied().chain(thetas.iter().map(|t| -t)).collect();
    let barycentric: Vec<f64> = (0..all.len())
        .map(|i| {
            let others = all.iter().enumerate().filter(|(j, _)| *j != i);
            // The span of the angles is π: its quarter keeps the product near 1.
            others.map(|(_, t)| 0.25 * std::f64::consts::PI / (all[i] - t)).product()
        })
        .collect();
    let parity = if m.is_multiple_of(2) { 1.0 } else { -1.0 };
    let n = thetas.len();
    let mut weights = RealMatrix::zeros(steps + 1 + BEYOND, n);
    for g in 0..steps + 1 + BEYOND {
        let theta = (g as f64 - BEYOND as f64) / steps as f64 * FRAC_PI_2;
        if let Some(at) = all.iter().position(|t| (t - theta).abs() < 1e-13) {
            weights[(g, at % n)] = if at < n { 1.0 } else { parity };
            continue;
        }
        let parts: Vec<f64> = barycentric.iter().zip(&all).map(|(b, t)| b / (theta - t)).collect();
        let sum: f64 = parts.iter().sum();
        for i in 0..n {
            weights[(g, i)] = (parts[i] + parity * parts[n + i]) / sum;
        }
    }
    weights
}

/// W f Wᵀ for every pair of components.
fn spread(f: &RealMatrix, weights: &RealMatrix) -> RealMatrix {
    let wide = RealMatrix::from_fn(4 * weights.nrows(), 4 * weights.ncols(), |i, j| {
        if i % 4 == j % 4 { weights[(i / 4, j / 4)] } else { 0.0 }
    });
    &wide * f * wide.transpose()
}
