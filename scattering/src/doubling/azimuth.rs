//! Azimuthal modes of a kernel by quadrature over the difference of azimuths.
//!
//! By mirror symmetry the half circle is enough: the midpoint rule on φ ∈ (0, π), which converges
//! exponentially. Blocks of M₊ on the diagonal take cos mφ, 01 takes −sin mφ, 10 takes sin mφ.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::block::{RealMatrix, Stokes4};

/// M₊ of the modes 0 … `last` of the kernel `at(i, j, (cos φ, sin φ))` from node `j` to node `i`,
/// with rows 4·node + component; `points` azimuths.
pub fn modes(
    (rows, columns): (usize, usize),
    last: usize,
    points: usize,
    at: impl Fn(usize, usize, (f64, f64)) -> Stokes4 + Sync,
) -> Vec<RealMatrix> {
    let azimuth = |k: usize| PI * (k as f64 + 0.5) / points as f64;
    let turns: Vec<(f64, f64)> =
        (0..points).map(|k| (azimuth(k).cos(), azimuth(k).sin())).collect();
    let waves: Vec<Vec<(f64, f64)>> = (0..points)
        .map(|k| {
            let wave = |m: usize| {
                let (sin, cos) = (m as f64 * azimuth(k)).sin_cos();
                (cos / points as f64, sin / points as f64)
            };
            (0..=last).map(wave).collect()
        })
        .collect();
    let column = |j: usize| -> Vec<Stokes4> {
        let mut sums = vec![[[0.0; 4]; 4]; rows * (last + 1)];
        for i in 0..rows {
            crate::interrupt::check();
            for (turn, waves) in turns.iter().zip(&waves) {
                let m = at(i, j, *turn);
                for (sum, (cos, sin)) in sums[i * (last + 1)..].iter_mut().zip(waves) {
                    for a in 0..2 {
                        for b in 0..2 {
                            sum[a][b] += m[a][b] * cos;
                            sum[a + 2][b + 2] += m[a + 2][b + 2] * cos;
                            sum[a][b + 2] -= m[a][b + 2] * sin;
                            sum[a + 2][b] += m[a + 2][b] * sin;
                        }
                    }
                }
            }
        }
        sums
    };
    let sums: Vec<Vec<Stokes4>> = (0..columns).into_par_iter().map(column).collect();
    (0..=last)
        .map(|m| {
            RealMatrix::from_fn(4 * rows, 4 * columns, |i, j| {
                sums[j / 4][i / 4 * (last + 1) + m][i % 4][j % 4]
            })
        })
        .collect()
}
