//! Mirrors and refracting facets between two directions, in the bases s = φ̂, p = k × s.
//!
//! With e ∥ n̂ × k_i and p' = k × e for both rays the Jones matrix is
//!
//! $$ J = \begin{pmatrix} s_o\cdot e & s_o\cdot p'_o\\ p_o\cdot e & p_o\cdot p'_o\end{pmatrix}
//!    \begin{pmatrix} C_s & 0\\ 0 & C_p\end{pmatrix}
//!    \begin{pmatrix} e\cdot s_i & e\cdot p_i\\ p'_i\cdot s_i & p'_i\cdot p_i\end{pmatrix} $$

use glam::DVec3;
use num_complex::Complex64;

use super::block::Stokes4;
use crate::Jones;

/// sin ι below which the plane of incidence of a facet is arbitrary.
const NORMAL: f64 = 1e-9;

/// A ray with its basis.
#[derive(Clone, Copy, Debug)]
pub struct PolarizedRay {
    /// Direction of propagation.
    pub k: DVec3,
    s: DVec3,
    p: DVec3,
}

impl PolarizedRay {
    /// The ray with the cosine `u` (negative downwards) at the azimuth with this cosine and sine.
    pub fn new(u: f64, (cos, sin): (f64, f64)) -> Self {
        let sine = (1.0 - u * u).max(0.0).sqrt();
        let k = DVec3::new(sine * cos, sine * sin, u);
        let s = DVec3::new(-sin, cos, 0.0);
        Self { k, s, p: k.cross(s) }
    }

    /// The ray along the unit vector `k`.
    pub fn along(k: DVec3) -> Self {
        let sine = k.x.hypot(k.y);
        let turn = if sine > 0.0 { (k.x / sine, k.y / sine) } else { (1.0, 0.0) };
        let s = DVec3::new(-turn.1, turn.0, 0.0);
        Self { k, s, p: k.cross(s) }
    }
}

/// The Mueller matrix of a facet with the normal `normal` and the coefficients (s, p).
pub fn mueller(
    into: &PolarizedRay,
    out: &PolarizedRay,
    normal: DVec3,
    [cs, cp]: [Complex64; 2],
) -> Stokes4 {
    let across = normal.cross(into.k);
    let size = across.length();
    let e = if size > NORMAL { across / size } else { into.s };
    let (p_in, p_out) = (into.k.cross(e), out.k.cross(e));
    let a = [e.dot(into.s), e.dot(into.p), p_in.dot(into.s), p_in.dot(into.p)];
    let b = [out.s.dot(e), out.s.dot(p_out), out.p.dot(e), out.p.dot(p_out)];
    let jones = Jones {
        ss: cs * (b[0] * a[0]) + cp * (b[1] * a[2]),
        ps: cs * (b[0] * a[1]) + cp * (b[1] * a[3]),
        sp: cs * (b[2] * a[0]) + cp * (b[3] * a[2]),
        pp: cs * (b[2] * a[1]) + cp * (b[3] * a[3]),
    };
    jones.mueller().0
}

/// `factor` times the matrix.
pub fn scaled(mut m: Stokes4, factor: f64) -> Stokes4 {
    m.iter_mut().flatten().for_each(|x| *x *= factor);
    m
}
