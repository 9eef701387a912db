//! Light scattered once, computed exactly and apart from the azimuthal modes, of which it needs many.
//!
//! A slab below smooth interfaces has the BRDF
//!
//! $$ f = \frac{\tau_s}{n^2\tau}\,T_s\,Z\,T_i\,
//!    \frac{1-e^{-\tau(1/\mu_i+1/\mu_s)}}{\mu_i+\mu_s} \qquad (1) $$
//!
//! with the cosines inside, T the transmission along the path of a ray, τ the extinction depth
//! without the forward peak. The modes of f with the truncated phase matrix are subtracted at the
//! nodes; f with the complete phase matrix and the complete scattering depth τ_s is added for every
//! pair of directions.
//!
//! T. Nakajima and M. Tanaka, J. Quant. Spectrosc. Radiat. Transfer 40, 51 (1988).

use std::{f64::consts::PI, sync::Arc};

use glam::DVec3;
use num_complex::Complex64;

use super::{block::Stokes4, interface::SmoothFace, phase_table::PhaseTable};
use crate::{Jones, Mueller};

/// Sine of the scattering angle below which the scattering plane is arbitrary.
const ALONG: f64 = 1e-9;

/// A slab that is seen through smooth faces.
#[derive(Clone, Debug)]
pub struct SingleSlab {
    /// Faces above it from the uppermost on, with the index below each and the extinction depth of
    /// the slab there; that of the last one is the slab itself.
    pub(super) faces: Vec<(SmoothFace, f64, f64)>,
    /// τ_s.
    pub(super) scattering: f64,
    /// The phase matrix.
    pub(super) phase: Arc<PhaseTable>,
}

/// A ray from outside in a slab.
#[derive(Clone, Copy, Debug)]
pub struct SlabRay {
    /// sin θ and cos θ inside.
    sin: f64,
    pub(super) mu: f64,
    /// Transmission on the way.
    pub(super) passes: Stokes4,
}

impl SingleSlab {
    /// The ray that has the sine `sin` outside.
    pub fn ray(&self, sin: f64) -> SlabRay {
        let kappa2 = sin * sin;
        let mu = |n: f64| (1.0 - kappa2 / (n * n)).max(0.0).sqrt();
        let (mut above, mut left) = (1.0, 1.0);
        let [mut s, mut p] = [Complex64::ONE; 2];
        for (j, (face, n, depth)) in self.faces.iter().enumerate() {
            let [_, [ts, tp]] = face.facet(mu(above), above, (*n).into());
            (s, p, above) = (s * ts, p * tp, *n);
            if j + 1 < self.faces.len() {
                left *= (-depth / mu(*n)).exp();
            }
        }
        let passes = Jones::diagonal(s, p).mueller().0.map(|row| row.map(|x| x * left));
        SlabRay { sin: sin / above, mu: mu(above), passes }
    }

    /// n of the slab and its extinction depth.
    fn slab(&self) -> (f64, f64) {
        self.faces.last().map_or((1.0, 0.0), |(_, n, depth)| (*n, *depth))
    }

    /// f without Z and T.
    pub(super) fn strength(&self, scattering: f64, mu_i: f64, mu_s: f64) -> f64 {
        let (n, depth) = self.slab();
        let exponent = depth * (1.0 / mu_i + 1.0 / mu_s);
        scattering * -(-exponent).exp_m1() / (n * n * depth * (mu_i + mu_s))
    }

    /// f of the whole phase matrix towards the azimuth with this cosine and sine, 1/sr.
    pub fn mueller(&self, into: &SlabRay, out: &SlabRay, (cos, sin): (f64, f64)) -> Mueller {
        let (k_in, s_in) = (DVec3::new(into.sin, 0.0, -into.mu), DVec3::Y);
        let k = DVec3::new(out.sin * cos, out.sin * sin, out.mu);
        let s = DVec3::new(-sin, cos, 0.0);
        let p_in = k_in.cross(s_in);
        let across = k_in.cross(k);
        let size = across.length();
        let across = if size > ALONG { across / size } else { s_in };
        let (par_in, par) = (k_in.cross(across), k.cross(across));
        let elements = self.phase.at(k_in.dot(k), size);
        let factor = self.strength(self.scattering, into.mu, out.mu) / (4.0 * PI);
        let [a1, a2, a3, a4, b1, b2] = elements.map(|x| x * factor);
        // (s, p) in to (∥, ⊥) of the scattering plane and from there to (s, p) out: one of the two is
        // left handed, so that the Jones matrices are ((c, d), (d, −c)).
        let (ci, di) = double(par_in.dot(s_in), par_in.dot(p_in));
        let (co, so) = double(s.dot(par), s.dot(across));
        let q = [b1, a2 * ci, a2 * di];
        let u = [0.0, a3 * di, -a3 * ci];
        let z = [
            [a1, b1 * ci, b1 * di, 0.0],
            [co * q[0], co * q[1] + so * u[1], co * q[2] + so * u[2], -so * b2],
            [so * q[0], so * q[1] - co * u[1], so * q[2] - co * u[2], co * b2],
            [0.0, b2 * di, -b2 * ci, a4],
        ];
        Mueller(passed(&out.passes, &z, &into.passes))
    }
}

/// (cos 2t, sin 2t) of (cos t, sin t).
fn double(c: f64, d: f64) -> (f64, f64) {
    (c * c - d * d, 2.0 * c * d)
}

/// The product of three matrices, the outer two with 2×2 blocks on the diagonal.
fn passed(out: &Stokes4, m: &Stokes4, into: &Stokes4) -> Stokes4 {
    let pair = |i: usize| i / 2 * 2;
    let left: Stokes4 = std::array::from_fn(|i| {
        let k = pair(i);
        std::array::from_fn(|j| out[i][k] * m[k][j] + out[i][k + 1] * m[k + 1][j])
    });
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let k = pair(j);
            left[i][k] * into[k][j] + left[i][k + 1] * into[k + 1][j]
        })
    })
}
