//! Comparison of a table, measured or written by another program, with a material.

use std::io::{Read, Seek};

use mist_engine::{Control, material::PreparedMaterial};
use rayon::prelude::*;
use scattering::Mueller;

use super::{
    super::{axes::LOWEST, frame::HalfAngles},
    header::PbsdfHeader,
    models::{bands, matrices},
};
use crate::{
    export::{Bands, ExportError},
    tensor::TensorReader,
};

/// Numbers per part that is read at once: 8 MB.
const PART: usize = 1 << 21;

/// The differences between a table and a material, over the nodes above the horizon with finite
/// values.
#[derive(Clone, Debug, PartialEq)]
pub struct PbsdfComparison {
    /// Wavelengths of the table, nm.
    pub nm: Vec<f64>,
    /// Number of compared nodes over all wavelengths.
    pub compared: u64,
    /// Number of nodes whose value is not finite.
    pub empty: u64,
    /// Number of nodes below the horizon, where the format leaves the values free.
    pub below: u64,
    /// The differences per wavelength.
    pub found: Vec<BandDifference>,
}

/// The differences at one wavelength, relative to M00 of the material.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BandDifference {
    /// Light of the table over light of the material, over all directions.
    pub brightness: f64,
    /// Σ |ΔM00| / Σ M00, over all directions, weighted by solid angles and cosines.
    pub mean: f64,
    /// The largest difference of an element at a node, over M00 there.
    pub largest: f64,
    /// Σ |ΔM_ij| / Σ M00 of each element, row by row, with the weights of `mean`.
    pub elements: [f64; 16],
    /// Σ_ij Σ |ΔM_ij| / Σ M00 after the table was brought to each of [`StokesSigns::ALL`].
    pub by_signs: [f64; 4],
}

/// Signs of Stokes components in a table, against those of the format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StokesSigns {
    /// Those of the format: V > 0 turns clockwise seen towards the light.
    Same,
    /// The opposite sign of V: the other hand of circular polarization.
    OtherV,
    /// The opposite sign of U: the azimuth of polarization is counted the other way.
    OtherU,
    /// The opposite signs of U and V: a mirrored frame.
    OtherUAndV,
}

impl StokesSigns {
    /// Every choice.
    pub const ALL: [Self; 4] = [Self::Same, Self::OtherV, Self::OtherU, Self::OtherUAndV];

    /// The sign of the element in `row` and `column` under this choice.
    fn of(self, row: usize, column: usize) -> f64 {
        let flips = |component: usize| match self {
            Self::Same => false,
            Self::OtherV => component == 3,
            Self::OtherU => component == 2,
            Self::OtherUAndV => component >= 2,
        };
        if flips(row) == flips(column) { 1.0 } else { -1.0 }
    }
}

impl PbsdfComparison {
    /// The choice of signs with which the table comes nearest to the material, over all
    /// wavelengths; [`StokesSigns::Same`] unless another one halves the difference.
    pub fn signs(&self) -> StokesSigns {
        let total = |k: usize| self.found.iter().map(|band| band.by_signs[k]).sum::<f64>();
        let all = (1..4).map(|k| (k, total(k)));
        let best = all.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|best| best.1 < 0.5 * total(0));
        best.map_or(StokesSigns::Same, |(k, _)| StokesSigns::ALL[k])
    }

    /// Row, column and mean difference over M00 of the elements that differ by more than `least`,
    /// over all wavelengths, the largest first.
    pub fn different_elements(&self, least: f64) -> Vec<(usize, usize, f64)> {
        let bands = self.found.len().max(1) as f64;
        let mean = |e: usize| self.found.iter().map(|band| band.elements[e]).sum::<f64>() / bands;
        let mut all: Vec<_> = (0..16).map(|e| (e / 4, e % 4, mean(e))).collect();
        all.retain(|(_, _, difference)| *difference > least);
        all.sort_by(|a, b| b.2.total_cmp(&a.2));
        all
    }
}

/// DifferenceSums at one wavelength.
#[derive(Clone, Copy, Default)]
struct DifferenceSums {
    theirs: f64,
    ours: f64,
    difference: f64,
    largest: f64,
    elements: [f64; 16],
    by_signs: [f64; 4],
}

/// Counts and sums of a part of the table.
#[derive(Clone, Default)]
struct DifferenceTally {
    compared: u64,
    empty: u64,
    below: u64,
    sums: Vec<DifferenceSums>,
}

/// Compares the table in `source` with `material`; the table is read in parts.
///
/// # Errors
///
/// If the file is not a `.pbsdf` or the material has no such table, and on cancellation.
pub fn compare<R: Read + Seek>(
    source: R,
    material: &PreparedMaterial,
    control: &Control,
) -> Result<PbsdfComparison, ExportError> {
    let mut file = TensorReader::open(source)?;
    let header = PbsdfHeader::read(&mut file)?;
    let bands = bands(material, &header.axes[3], false)?;
    let (row, n_d) = (header.row(), header.axes[1].len());
    let rows = header.axes[0].len() * n_d;
    let step = (PART / row).max(1);
    let mut all = DifferenceTally {
        sums: vec![DifferenceSums::default(); bands.nm().len()],
        ..DifferenceTally::default()
    };
    for first in (0..rows).step_by(step) {
        if control.is_cancelled() {
            return Err(ExportError::Cancelled);
        }
        let last = (first + step).min(rows);
        let numbers = file.f32s("M", (first * row) as u64, ((last - first) * row) as u64)?;
        let tallies: Vec<DifferenceTally> = (first..last)
            .into_par_iter()
            .map(|at| {
                let row = &numbers[(at - first) * row..][..row];
                tally(&bands, &header, [at / n_d, at % n_d], row)
            })
            .collect();
        tallies.iter().for_each(|tally| all.add(tally));
        control.report(last as f64 / rows as f64);
    }
    let found = |sums: &DifferenceSums| BandDifference {
        brightness: sums.theirs / sums.ours,
        mean: sums.difference / sums.ours,
        largest: sums.largest,
        elements: sums.elements.map(|sum| sum / sums.ours),
        by_signs: sums.by_signs.map(|sum| sum / sums.ours),
    };
    Ok(PbsdfComparison {
        nm: header.axes[3].clone(),
        compared: all.compared,
        empty: all.empty,
        below: all.below,
        found: all.sums.iter().map(found).collect(),
    })
}

/// The differences of all θ_h and wavelengths at one φ_d and θ_d.
fn tally(bands: &Bands, header: &PbsdfHeader, [i, j]: [usize; 2], row: &[f32]) -> DifferenceTally {
    let waves = bands.nm().len();
    let mut all = DifferenceTally {
        sums: vec![DifferenceSums::default(); waves],
        ..DifferenceTally::default()
    };
    for (k, numbers) in row.chunks_exact(16 * waves).enumerate() {
        let at = HalfAngles {
            phi_d: header.axes[0][i],
            theta_d: header.axes[1][j],
            theta_h: header.axes[2][k],
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
            * width(&header.axes[1], j)
            * width(&header.axes[2], k);
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

/// The width of the interval around node `k`.
fn width(nodes: &[f64], k: usize) -> f64 {
    let (low, high) = (k.saturating_sub(1), (k + 1).min(nodes.len() - 1));
    0.5 * (nodes[high] - nodes[low])
}

impl DifferenceSums {
    fn node(&mut self, theirs: Mueller, ours: Mueller, weight: f64) {
        let difference = theirs - ours;
        self.theirs += weight * theirs[(0, 0)];
        self.ours += weight * ours[(0, 0)];
        self.difference += weight * difference[(0, 0)].abs();
        for (e, sum) in self.elements.iter_mut().enumerate() {
            *sum += weight * difference[(e / 4, e % 4)].abs();
        }
        for (signs, sum) in StokesSigns::ALL.iter().zip(&mut self.by_signs) {
            let of = |e: usize| {
                let at = (e / 4, e % 4);
                (signs.of(at.0, at.1) * theirs[at] - ours[at]).abs()
            };
            *sum += weight * (0..16).map(of).sum::<f64>();
        }
        // Subnormal 32-bit numbers lose digits.
        if ours[(0, 0)] > f64::from(f32::MIN_POSITIVE) {
            self.largest = self.largest.max(difference.largest() / ours[(0, 0)]);
        }
    }
}

impl DifferenceTally {
    fn add(&mut self, other: &Self) {
        self.compared += other.compared;
        self.empty += other.empty;
        self.below += other.below;
        for (sum, more) in self.sums.iter_mut().zip(&other.sums) {
            sum.theirs += more.theirs;
            sum.ours += more.ours;
            sum.difference += more.difference;
            sum.largest = sum.largest.max(more.largest);
            sum.elements.iter_mut().zip(more.elements).for_each(|(sum, more)| *sum += more);
            sum.by_signs.iter_mut().zip(more.by_signs).for_each(|(sum, more)| *sum += more);
        }
    }
}
