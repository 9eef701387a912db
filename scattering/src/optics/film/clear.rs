//! Films in which a wave travels without loss, for one angle or several at once.
//!
//! $$ F = \begin{pmatrix} \cos\delta & -i\sin\delta/Y \\ -iY\sin\delta & \cos\delta \end{pmatrix},
//!    \quad \delta = 2\pi t q/\lambda, \quad Y = q,\; q/n^2 $$
//!
//! has real δ and Y there: two real and two imaginary elements, and no factor e^{iδ} is needed.
//!
//! M. Born and E. Wolf, *Principles of Optics*, 7th ed. (1999), section 1.6.

use super::layer::{FilmLayer, FilmMedium};
use crate::lanes::{Complex, Real};

/// Phase below which sin δ / q is computed from its series.
pub(super) const SMALL_PHASE: f64 = 1e-2;

/// (1, Y) of s and of p, carried through films.
type Tangential<R> = [[Complex<R>; 2]; 2];

/// The vector `v` at the far face of a film without loss, propagated to its near face.
#[inline(always)]
pub(super) fn passed<R: Real>(v: Tangential<R>, layer: &FilmLayer, q: R) -> Tangential<R> {
    if layer.phase == 0.0 {
        return v;
    }
    let delta = q * layer.phase;
    let (sin, cos) = delta.sin_cos();
    let d2 = delta * delta;
    let series = d2 * (1.0 / 42.0) + -1.0;
    let series = d2 * (1.0 / 20.0) * series + 1.0;
    let series = (-(d2 * (1.0 / 6.0) * series) + 1.0) * layer.phase;
    let sin_over_q = (d2 - SMALL_PHASE * SMALL_PHASE).select(sin / q, series);
    let FilmMedium { epsilon, inverse_epsilon, .. } = layer.medium;
    let [[e, h], [u, w]] = v;
    [
        [e * cos + h.turned_back(sin_over_q), h * cos + e.turned_back(q * sin)],
        [
            u * cos + w.turned_back(sin_over_q * epsilon.re),
            w * cos + u.turned_back(q * sin * inverse_epsilon.re),
        ],
    ]
}
