//! Azimuthal modes of a phase matrix between directions with respect to the normal.
//!
//! From the cosine u' to u, in the bases s = φ̂ and p = k × s of each direction,
//!
//! $$ \mathbf Z_+^m(u,u') = \frac1{4\pi}\sum_{l\ge m}\Pi_l(u)\,B_l\,\Pi_l(u'), \qquad
//!    \Pi = \begin{pmatrix}\delta&0&0&0\\0&\rho&-\tau&0\\0&-\tau&\rho&0\\0&0&0&\delta\end{pmatrix},
//!    \qquad B = \begin{pmatrix}\alpha_1&-\beta_1&0&0\\-\beta_1&\alpha_2&0&0\\
//!    0&0&\alpha_3&-\beta_2\\0&0&\beta_2&\alpha_4\end{pmatrix} $$
//!
//! δ = d^l_m0, ρ = ½(d^l_m2 + d^l_m,−2), τ = ½(d^l_m2 − d^l_m,−2). Z(−u, −u') = D Z(u, u') D.
//!
//! C. E. Siewert, Astrophys. J. 245, 1080 (1981); J. W. Hovenier, C. van der Mee and H. Domke,
//! *Transfer of Polarized Light in Planetary Atmospheres* (Kluwer, 2004), 3.4.

use super::{
    block::{RealMatrix, TransferBlock},
    expansion::PhaseExpansion,
    nodes::MediumDirections,
    wigner::wigner_d,
};

/// 2π√(w_i w_j) Z between the nodes `directions` for one scattering, (down to down, down to up).
pub fn modes(
    block: TransferBlock,
    directions: &MediumDirections,
    series: &PhaseExpansion,
) -> (RealMatrix, RealMatrix) {
    let down: Vec<f64> = directions.mu.iter().map(|mu| -mu).collect();
    let root: Vec<f64> = directions.w.iter().map(|w| (0.5 * w).sqrt()).collect();
    let into = harmonics(block, &down, series.terms.len() - 1, &root);
    let out = harmonics(block, &directions.mu, series.terms.len() - 1, &root);
    let scattered = weighted(block, &into, series).transpose().to_owned();
    (&into * &scattered, out * scattered)
}

/// Π_l(u) of all directions (rows) and all l ≥ m (columns), times `root`.
fn harmonics(block: TransferBlock, cosines: &[f64], top: usize, root: &[f64]) -> RealMatrix {
    let m = block.mode();
    let orders = (top + 1).saturating_sub(m);
    let mode = m as i32;
    let all: Vec<[Vec<f64>; 3]> =
        cosines.iter().map(|u| [0, 2, -2].map(|n| wigner_d(mode, n, *u, top))).collect();
    block.assembled(cosines.len(), orders, |i, l| {
        let [zero, plus, minus] = [0, 1, 2].map(|k| all[i][k][l + m] * root[i]);
        let (rho, tau) = (0.5 * (plus + minus), 0.5 * (plus - minus));
        [[zero, 0.0, 0.0, 0.0], [0.0, rho, -tau, 0.0], [0.0, -tau, rho, 0.0], [0.0, 0.0, 0.0, zero]]
    })
}

/// Π_l(u) B_lᵀ for every l: its transpose is B_l Π_l(u).
fn weighted(block: TransferBlock, harmonics: &RealMatrix, series: &PhaseExpansion) -> RealMatrix {
    let (s, first, m) = (block.size(), block.first(), block.mode());
    let mut product = RealMatrix::zeros(harmonics.nrows(), harmonics.ncols());
    for (l, [a1, a2, a3, a4, b1, b2]) in series.terms.iter().enumerate().skip(m) {
        let b = [
            [*a1, -b1, 0.0, 0.0],
            [-b1, *a2, 0.0, 0.0],
            [0.0, 0.0, *a3, -b2],
            [0.0, 0.0, *b2, *a4],
        ];
        for row in 0..harmonics.nrows() {
            for c in 0..s {
                let sum =
                    (0..s).map(|k| b[first + c][first + k] * harmonics[(row, s * (l - m) + k)]);
                product[(row, s * (l - m) + c)] = sum.sum();
            }
        }
    }
    product
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use glam::DVec3;

    use super::*;
    use crate::Jones;

    fn c(x: f64) -> num_complex::Complex64 {
        x.into()
    }

    /// The direction and its s and p.
    fn frame(u: f64, phi: f64) -> [DVec3; 3] {
        let sin = (1.0 - u * u).sqrt();
        let k = DVec3::new(sin * phi.cos(), sin * phi.sin(), u);
        let s = DVec3::new(-phi.sin(), phi.cos(), 0.0);
        [k, s, k.cross(s)]
    }

    /// The phase matrix turned into the bases of both directions, 1/sr.
    fn turned(series: &PhaseExpansion, u: f64, v: f64, phi: f64) -> crate::Mueller {
        let ([k_in, s_in, p_in], [k, s, p]) = (frame(v, 0.0), frame(u, phi));
        let across = k_in.cross(k).normalize();
        let [par_in, par] = [k_in, k].map(|k| k.cross(across));
        let [a1, a2, a3, a4, b1, b2] = series.at_cosine(k.dot(k_in)).map(|x| x / (4.0 * PI));
        let own = crate::Mueller([
            [a1, b1, 0.0, 0.0],
            [b1, a2, 0.0, 0.0],
            [0.0, 0.0, a3, b2],
            [0.0, 0.0, -b2, a4],
        ]);
        let jones = |a: [f64; 4]| Jones { ss: c(a[0]), ps: c(a[1]), sp: c(a[2]), pp: c(a[3]) };
        let into = jones([par_in.dot(s_in), par_in.dot(p_in), across.dot(s_in), across.dot(p_in)]);
        let out = jones([s.dot(par), s.dot(across), p.dot(par), p.dot(across)]);
        out.mueller() * own * into.mueller()
    }

    /// Z_+ of one pair of cosines, 1/sr.
    fn between_cosines(mode: usize, out: f64, into: f64, series: &PhaseExpansion) -> [[f64; 4]; 4] {
        let blocks = if mode == 0 {
            vec![TransferBlock::Intensity, TransferBlock::Circular]
        } else {
            vec![TransferBlock::Mode(mode)]
        };
        let (top, weight) = (series.terms.len() - 1, [1.0 / (4.0 * PI).sqrt()]);
        let mut whole = [[0.0; 4]; 4];
        for block in blocks {
            let [into, out] = [into, out].map(|u| harmonics(block, &[u], top, &weight));
            let z = out * weighted(block, &into, series).transpose();
            for a in 0..block.size() {
                for b in 0..block.size() {
                    whole[block.first() + a][block.first() + b] = z[(a, b)];
                }
            }
        }
        whole
    }

    /// Made up, with all six elements.
    fn series() -> PhaseExpansion {
        let terms = (0..12).map(|l| {
            let x = 0.55f64.powi(l) * f64::from(2 * l + 1);
            let pair = if l < 2 { 0.0 } else { x };
            [x, 0.9 * pair, 0.7 * pair, 0.6 * x, -0.2 * pair, 0.1 * pair]
        });
        PhaseExpansion { terms: terms.collect() }
    }

    #[test]
    fn modes_are_those_of_the_turned_matrix() {
        let series = series();
        let points = 64;
        for (u, v) in [(0.3, -0.8), (-0.3, -0.8), (0.9, 0.2), (-0.6, 0.5)] {
            for m in 0..=6 {
                let z = between_cosines(m, u, v, &series);
                let mut sum = [[0.0; 4]; 4];
                for k in 0..points {
                    let phi = TAU * (f64::from(k) + 0.5) / f64::from(points);
                    let here = turned(&series, u, v, phi);
                    let (sin, cos) = (m as f64 * phi).sin_cos();
                    for i in 0..4 {
                        for j in 0..4 {
                            let wave = match (i < 2, j < 2) {
                                (true, false) => -sin,
                                (false, true) => sin,
                                _ => cos,
                            };
                            sum[i][j] += here.0[i][j] * wave / f64::from(points);
                        }
                    }
                }
                for (a, b) in z.iter().flatten().zip(sum.iter().flatten()) {
                    assert!((a - b).abs() < 1e-14, "{m} {u} {v}: {z:?} {sum:?}");
                }
            }
        }
    }
}
