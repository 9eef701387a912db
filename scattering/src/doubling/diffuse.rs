//! The diffuse reflection of a stack: azimuthal modes of its BRDF at the nodes outside.
//!
//! R_ij = 2π f₊(μ_i, μ_j) √(μ_i w_i μ_j w_j) for scattered light. Three parts are subtracted: the mirror
//! reflection of smooth interfaces, which is not part of a BRDF; one reflection at the facets of a
//! rough uppermost interface; and light scattered once. The last two are computed without modes.
//! Modes are solved in parallel, a fixed number at a time, until two consecutive ones are smaller
//! than the tolerance.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::{
    block::{RealMatrix, TransferBlock},
    nodes::MediumDirections,
    stack::TransferProblem,
};

/// Modes solved in parallel before their size is compared with the tolerance.
const CHUNK: usize = 4;

/// Modes of a diffuse BRDF, 1/sr, between nodes.
#[derive(Clone, Debug)]
pub struct DiffuseModes {
    /// The directions outside.
    pub directions: MediumDirections,
    /// f₊ of every mode from 0 on, with the row 4·node + component.
    pub modes: Vec<RealMatrix>,
    /// Mirror reflection of each node, as a Mueller matrix.
    pub direct: Vec<RealMatrix>,
    /// The largest element of the last mode: an estimate of the modes that are left out.
    pub rest: f64,
}

impl DiffuseModes {
    /// Solves `transfer` with modes up to `most` until they are smaller than `tolerance` (1/sr).
    pub fn new(transfer: &TransferProblem<'_>, most: usize, tolerance: f64) -> Self {
        let directions = transfer.outside();
        let direct = transfer.direct();
        let mut modes: Vec<RealMatrix> = Vec::new();
        let mut rest = f64::INFINITY;
        while modes.len() <= most {
            let next = modes.len()..(modes.len() + CHUNK).min(most + 1);
            let solve = |m: usize| mode(transfer, &directions, &direct, m);
            let found: Vec<RealMatrix> = next.into_par_iter().map(solve).collect();
            modes.extend(found);
            let size = |back: usize| modes[modes.len() - back].norm_max();
            rest = size(1);
            if modes.len() > 2 && size(1) < tolerance && size(2) < tolerance {
                break;
            }
        }
        while modes.len() > 1 && modes[modes.len() - 1].norm_max() < 0.1 * tolerance {
            modes.pop();
        }
        Self { directions, modes, direct, rest }
    }
}

/// f₊ of mode `m`.
fn mode(
    transfer: &TransferProblem<'_>,
    directions: &MediumDirections,
    direct: &[RealMatrix],
    m: usize,
) -> RealMatrix {
    let n = directions.len();
    let root: Vec<f64> = (0..n).map(|i| directions.root_flux(i)).collect();
    let mut f = RealMatrix::zeros(4 * n, 4 * n);
    for block in TransferBlock::of_mode(m) {
        let mut r = transfer.reflection(block);
        if let Some(first) = transfer.first_reflection(m) {
            r -= block.of_whole(first);
        }
        let single = transfer.single_modes(block);
        let (s, first) = (block.size(), block.first());
        for j in 0..n * s {
            for i in 0..n * s {
                let (row, column) = (first + i % s, first + j % s);
                let same = if i / s == j / s { direct[i / s][(row, column)] } else { 0.0 };
                let scale = 2.0 * PI * root[i / s] * root[j / s];
                f[(4 * (i / s) + row, 4 * (j / s) + column)] =
                    (r[(i, j)] - same) / scale - single[(i, j)];
            }
        }
    }
    f
}
