//! A homogeneous slab: the exponential of a thin part of it, doubled.
//!
//! With s from 0 to 1 the depth in the slab, q_i = √(w_i/μ_i) and X_ij = 2πτω Z(u_i, u_j) q_i q_j,
//!
//! $$ \frac{d}{ds}\begin{pmatrix}\psi_\downarrow\\ \psi_\uparrow\end{pmatrix}
//!    = G \begin{pmatrix}\psi_\downarrow\\ \psi_\uparrow\end{pmatrix}, \qquad
//!    G = \begin{pmatrix} -K/\mu + X^{dd} & X^{du} \\ -X^{ud} & \bar K/\mu - X^{uu} \end{pmatrix} $$
//!
//! K the extinction matrix of the depth, K̄ = D K D. The part h = 2^{−k} with ‖G‖h ≤ ½ has the
//! matrix E = e^{Gh} = ((a, b), (c, d)), by the diagonal Padé form [6/6], and
//! T↑ = d⁻¹, R↓ = −d⁻¹c, T↓ = a + bR↓, R↑ = bd⁻¹. The mirror image of the slab is itself:
//! R↑ = D R↓ D and T↑ = D T↓ D at every doubling.
//!
//! P. C. Waterman, J. Opt. Soc. Am. 71, 410 (1981); N. J. Higham, *Functions of Matrices* (SIAM,
//! 2008), 10.3.

use super::{
    block::{
        RealMatrix, Stokes4, TransferBlock, between, identity, joined, norm, quarters, solved,
    },
    energy_balance,
    flakes::FlakeKernel,
    nodes::MediumDirections,
    operator::LayerOperator,
};

/// ‖G‖h of the thin part.
const THIN: f64 = 0.5;
/// A slab that transmits less than this is opaque.
const OPAQUE: f64 = 1e-14;
/// Coefficients of the diagonal Padé form [6/6] of the exponential.
const PADE: [f64; 7] =
    [1.0, 1.0 / 2.0, 5.0 / 44.0, 1.0 / 66.0, 1.0 / 792.0, 1.0 / 15840.0, 1.0 / 665280.0];

/// Extinction and scattering inside a slab, in one block.
#[derive(Clone, Debug)]
pub struct SlabMedium {
    /// Extinction matrix of the whole depth for light that goes down, at every node.
    pub extinction: Vec<Stokes4>,
    /// 2π√(w_i w_j) Z of the whole depth, down to down.
    pub down: RealMatrix,
    /// The same, down to up.
    pub up: RealMatrix,
}

impl SlabMedium {
    /// A medium that only absorbs, of the optical depth `depth`.
    pub fn clear(block: TransferBlock, directions: &MediumDirections, depth: f64) -> Self {
        let n = block.size() * directions.len();
        let extinction = vec![scalar(depth); directions.len()];
        Self { extinction, down: RealMatrix::zeros(n, n), up: RealMatrix::zeros(n, n) }
    }

    /// Adds `factor` times the scattering (down, up) and the scalar extinction `depth`.
    pub fn add(&mut self, factor: f64, (down, up): (&RealMatrix, &RealMatrix), depth: f64) {
        self.down += down * faer::Scale(factor);
        self.up += up * faer::Scale(factor);
        for k in &mut self.extinction {
            for (c, row) in k.iter_mut().enumerate() {
                row[c] += depth;
            }
        }
    }

    /// Adds flakes.
    pub fn add_flakes(&mut self, block: TransferBlock, flakes: &FlakeKernel) {
        if let Some((down, up)) = flakes.modes.get(block.mode()) {
            self.down += block.of_whole(down);
            self.up += block.of_whole(up);
        }
        for (k, more) in
            self.extinction.iter_mut().flatten().zip(flakes.extinction.iter().flatten())
        {
            for (x, y) in k.iter_mut().zip(more) {
                *x += y;
            }
        }
    }

    /// Reflection and transmission of the slab.
    pub fn operator(&self, block: TransferBlock, directions: &MediumDirections) -> LayerOperator {
        let (g, size) = self.generator(block, directions);
        let doublings = (size / THIN).log2().ceil().max(0.0) as i32;
        let n = self.down.nrows();
        let e = exponential(&(g * faer::Scale(0.5f64.powi(doublings))));
        let [[a, b], [c, d]] = quarters(&e, n, n);
        let mut r = solved(&d, &c) * faer::Scale(-1.0);
        let mut t = a + b * &r;
        for _ in 0..doublings {
            crate::interrupt::check();
            let back = block.mirrored(&r);
            let y = between(&back, &r, &t);
            r += block.mirrored(&t) * (&r * &y);
            t = &t * y;
            if norm(&t) < OPAQUE {
                t = RealMatrix::zeros(n, n);
                break;
            }
        }
        LayerOperator { r_up: block.mirrored(&r), t_up: block.mirrored(&t), r_down: r, t_down: t }
    }

    /// G and its norm.
    fn generator(&self, block: TransferBlock, directions: &MediumDirections) -> (RealMatrix, f64) {
        let s = block.size();
        let root = |row: usize| directions.mu[row / s].sqrt();
        let n = self.down.nrows();
        let scaled =
            |m: &RealMatrix| RealMatrix::from_fn(n, n, |i, j| m[(i, j)] / (root(i) * root(j)));
        let count = directions.len();
        let loss = block.diagonal((count, count, count), |i| {
            self.extinction[i].map(|row| row.map(|k| k / directions.mu[i]))
        });
        let dd = scaled(&self.down) - loss;
        let ud = scaled(&self.up);
        let minus = |m: &RealMatrix| m * faer::Scale(-1.0);
        let (du, uu) = (block.mirrored(&ud), block.mirrored(&dd));
        let g = joined([[&dd, &du], [&minus(&ud), &minus(&uu)]]);
        let size = norm(&g);
        (g, size)
    }
}

/// `k` times the identity.
fn scalar(k: f64) -> Stokes4 {
    let mut m = [[0.0; 4]; 4];
    for (c, row) in m.iter_mut().enumerate() {
        row[c] = k;
    }
    m
}

/// e^m for ‖m‖ ≤ ½.
pub fn exponential(m: &RealMatrix) -> RealMatrix {
    let one = identity(m.nrows());
    let m2 = m * m;
    let m4 = &m2 * &m2;
    let m6 = &m4 * &m2;
    let times = |m: &RealMatrix, k: usize| m * faer::Scale(PADE[k]);
    let odd = m * (times(&one, 1) + times(&m2, 3) + times(&m4, 5));
    let even = times(&one, 0) + times(&m2, 2) + times(&m4, 4) + times(&m6, 6);
    solved(&(&even - &odd), &(&even + &odd))
}

/// Restores the energy balance of the scattering (down, up) of a lossless medium: every column of I
/// carries its own flux, every column of Q none.
pub fn close(
    block: TransferBlock,
    directions: &MediumDirections,
    down: &mut RealMatrix,
    up: &mut RealMatrix,
) -> f64 {
    if block != TransferBlock::Intensity {
        return 0.0;
    }
    let n = down.nrows();
    // The mirrored halves are the same in this block.
    let mut both = joined([[down, up], [up, down]]);
    let root = |row: usize| {
        let node = row % n / 2;
        if row.is_multiple_of(2) { directions.w[node].sqrt() } else { 0.0 }
    };
    let flux: Vec<f64> = (0..2 * n).map(root).collect();
    let missed = energy_balance::restore(&mut both, &flux, &flux);
    let [[a, _], [c, _]] = quarters(&both, n, n);
    (*down, *up) = (a, c);
    missed
}
