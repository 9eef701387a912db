//! The weights of directions in a sum of Mueller matrices.
//!
//! A detector behind an aperture has its sensitivity S at the centre and S(β) = R(β) S in other
//! directions. What it sees of all is S·(Σ w R(β)ᵀ M)·Φ with
//!
//! $$ R^T M:\quad \text{rows 1 and 2 become}\quad
//!    \cos2\beta\,M_1 - \sin2\beta\,M_2, \quad \sin2\beta\,M_1 + \cos2\beta\,M_2 $$

use super::Mueller;
use crate::lanes::WIDTH;

/// The weights of directions, in their order.
#[derive(Clone, Debug, Default)]
pub struct DirectionWeights {
    /// Weights, without a unit or sr.
    pub weight: Vec<f64>,
    /// cos 2β, β the turn of the sensitivity.
    pub cos2b: Vec<f64>,
    /// sin 2β, as it is for light that leaves upwards.
    pub sin2b: Vec<f64>,
}

impl DirectionWeights {
    /// Adds a direction with this weight, cos 2β and sin 2β.
    pub fn push(&mut self, weight: f64, [cos2b, sin2b]: [f64; 2]) {
        self.weight.push(weight);
        self.cos2b.push(cos2b);
        self.sin2b.push(sin2b);
    }

    /// Adds the directions of `other` behind its own.
    pub fn extend(&mut self, other: &Self) {
        self.weight.extend(&other.weight);
        self.cos2b.extend(&other.cos2b);
        self.sin2b.extend(&other.sin2b);
    }

    /// Leaves `count` directions; those that come have the weight 0.
    pub fn resize(&mut self, count: usize) {
        self.weight.resize(count, 0.0);
        self.cos2b.resize(count, 0.0);
        self.sin2b.resize(count, 0.0);
    }

    /// The number of directions.
    pub fn count(&self) -> usize {
        self.weight.len()
    }

    /// All of them, for matrices of light that leaves upwards, or with `sign` = −1 downwards,
    /// where the sensitivity turns the other way.
    pub fn signed(&self, sign: f64) -> SignedWeights<'_> {
        SignedWeights { weight: &self.weight, cos2b: &self.cos2b, sin2b: &self.sin2b, sign }
    }
}

/// The weights of a part of the directions.
#[derive(Clone, Copy, Debug)]
pub struct SignedWeights<'a> {
    pub(crate) weight: &'a [f64],
    pub(crate) cos2b: &'a [f64],
    pub(crate) sin2b: &'a [f64],
    pub(crate) sign: f64,
}

impl SignedWeights<'_> {
    /// Adds w R(β)ᵀ `m` of direction `k` to `sum`.
    #[inline]
    pub fn add(&self, k: usize, m: &Mueller, sum: &mut Mueller) {
        let w = self.weight[k];
        let (c, s) = (w * self.cos2b[k], w * (self.sign * self.sin2b[k]));
        let sum = &mut sum.0;
        for k in 0..4 {
            sum[0][k] += w * m.0[0][k];
            sum[1][k] += c * m.0[1][k] - s * m.0[2][k];
            sum[2][k] += s * m.0[1][k] + c * m.0[2][k];
            sum[3][k] += w * m.0[3][k];
        }
    }

    /// The weights of a group that begins with direction `first`, 0 behind the last one.
    pub(crate) fn group(&self, first: usize) -> [[f64; WIDTH]; 3] {
        let from =
            |all: &[f64]| std::array::from_fn(|k| all.get(first + k).copied().unwrap_or(0.0));
        [self.weight, self.cos2b, self.sin2b].map(from)
    }

    /// The weights of the directions in `range`.
    pub(crate) fn part(self, range: std::ops::Range<usize>) -> Self {
        Self {
            weight: &self.weight[range.clone()],
            cos2b: &self.cos2b[range.clone()],
            sin2b: &self.sin2b[range],
            sign: self.sign,
        }
    }
}
