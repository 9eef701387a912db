//! A table, measured or written by another program, against a material.

use std::io::{Read, Seek};

use mist_engine::{Control, material::Prepared};
use rayon::prelude::*;
use scattering::Mueller;

use super::{
    super::{axes::LOWEST, frame::HalfAngles},
    bands, matrices,
    table::Head,
};
use crate::{export::ExportError, tensor::Reader};

/// Numbers that are held in memory at a time: 8 MB.
const CHUNK: usize = 1 << 21;

/// How a table differs from a material, over the nodes above the horizon that have numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Wavelengths of the table, nm.
    pub nm: Vec<f64>,
    /// Nodes that were compared, all wavelengths together.
    pub compared: u64,
    /// Nodes without a number in the table.
    pub empty: u64,
    /// Nodes below the horizon: the table fills them as it likes.
    pub below: u64,
    /// Per wavelength what was found.
    pub found: Vec<Differences>,
}

/// The differences at one wavelength, relative to M00 of the material; ideally all are 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Differences {
    /// Light of the table over light of the material, over all directions.
    pub brightness: f64,
    /// Σ |ΔM00| / Σ M00, over all directions, weighted by solid angles and cosines.
    pub mean: f64,
    /// The largest difference of an element at a node, over M00 there.
    pub largest: f64,
}

/// Sums at one wavelength.
#[derive(Clone, Copy, Default)]
struct Sums {
    theirs: f64,
    ours: f64,
    difference: f64,
    largest: f64,
}

#[derive(Clone, Default)]
struct Tally {
    compared: u64,
    empty: u64,
    below: u64,
    sums: Vec<Sums>,
}

/// Compares the table in `source` with `material`, reading it piece by piece.
///
/// # Errors
///
/// For files that are no `.pbsdf`, materials that have no such table, and a wish to stop.
pub fn compare<R: Read + Seek>(
    source: R,
    material: &Prepared,
    control: &Control,
) -> Result<Comparison, ExportError> {
    let mut file = Reader::open(source)?;
    let head = Head::read(&mut file)?;
    let bands = bands(material, &head.axes[3], false)?;
    let (row, n_d) = (head.row(), head.axes[1].len());
    let rows = head.axes[0].len() * n_d;
    let step = (CHUNK / row).max(1);
    let mut all = Tally { sums: vec![Sums::default(); bands.nm().len()], ..Tally::default() };
    for first in (0..rows).step_by(step) {
        if control.is_cancelled() {
            return Err(ExportError::Cancelled);
        }
        let last = (first + step).min(rows);
        let numbers = file.f32s("M", (first * row) as u64, ((last - first) * row) as u64)?;
        let tallies: Vec<Tally> = (first..last)
            .into_par_iter()
            .map(|at| {
                let row = &numbers[(at - first) * row..][..row];
                tally(&bands, &head, [at / n_d, at % n_d], row)
            })
            .collect();
        tallies.iter().for_each(|tally| all.add(tally));
        control.report(last as f64 / rows as f64);
    }
    let found = |sums: &Sums| Differences {
        brightness: sums.theirs / sums.ours,
        mean: sums.difference / sums.ours,
        largest: sums.largest,
    };
    Ok(Comparison {
        nm: head.axes[3].clone(),
        compared: all.compared,
        empty: all.empty,
        below: all.below,
        found: all.sums.iter().map(found).collect(),
    })
}

/// All θ_h and wavelengths at one φ_d and θ_d.
fn tally(bands: &crate::export::Bands, head: &Head, [i, j]: [usize; 2], row: &[f32]) -> Tally {
    let waves = bands.nm().len();
    let mut all = Tally { sums: vec![Sums::default(); waves], ..Tally::default() };
    for (k, numbers) in row.chunks_exact(16 * waves).enumerate() {
        let at = HalfAngles {
            phi_d: head.axes[0][i],
            theta_d: head.axes[1][j],
            theta_h: head.axes[2][k],
        };
        let (l, v) = at.directions();
        if l.z < LOWEST || v.z < LOWEST {
            all.below += waves as u64;
            continue;
        }
        let weight = l.z
            * v.z
            * at.theta_d.cos()
            * at.theta_d.sin()
            * at.theta_h.sin()
            * width(&head.axes[1], j)
            * width(&head.axes[2], k);
        let ours = matrices(bands, &at);
        for ((numbers, ours), sums) in numbers.chunks_exact(16).zip(ours).zip(&mut all.sums) {
            if numbers.iter().any(|x| !x.is_finite()) {
                all.empty += 1;
                continue;
            }
            all.compared += 1;
            let theirs = Mueller::from_row_major(std::array::from_fn(|e| numbers[e].into()));
            sums.node(theirs, ours, weight);
        }
    }
    all
}

/// The width of the cell of a node.
fn width(nodes: &[f64], k: usize) -> f64 {
    let (low, high) = (k.saturating_sub(1), (k + 1).min(nodes.len() - 1));
    0.5 * (nodes[high] - nodes[low])
}

impl Sums {
    fn node(&mut self, theirs: Mueller, ours: Mueller, weight: f64) {
        let difference = theirs - ours;
        self.theirs += weight * theirs[(0, 0)];
        self.ours += weight * ours[(0, 0)];
        self.difference += weight * difference[(0, 0)].abs();
        // Smaller 32-bit numbers lose digits.
        if ours[(0, 0)] > f64::from(f32::MIN_POSITIVE) {
            self.largest = self.largest.max(difference.largest() / ours[(0, 0)]);
        }
    }
}

impl Tally {
    fn add(&mut self, other: &Self) {
        self.compared += other.compared;
        self.empty += other.empty;
        self.below += other.below;
        for (sum, more) in self.sums.iter_mut().zip(&other.sums) {
            sum.theirs += more.theirs;
            sum.ours += more.ours;
            sum.difference += more.difference;
            sum.largest = sum.largest.max(more.largest);
        }
    }
}
