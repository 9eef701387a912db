//! The Jones matrix of a tilted facet: its own s and p turned into those of the two rays.
//!
//! The facet's s direction is perpendicular to both rays, along w = k_o × k_i. With
//!
//! $$ c = w\cdot s_i,\quad d = w\cdot p_i,\quad C = w\cdot s_o,\quad D = w\cdot p_o, \qquad
//!    c^2+d^2 = C^2+D^2 = |w|^2 $$
//!
//! $$ J = \frac{1}{|w|^2} \begin{pmatrix} C & -D \\ D & C \end{pmatrix}
//!    \begin{pmatrix} r_s & 0 \\ 0 & r_p \end{pmatrix}
//!    \begin{pmatrix} c & d \\ -d & c \end{pmatrix} $$
//!
//! For reflection |w| = sin 2ι and the elements are the published q_ij/a₁. w is computed once and
//! projected on both bases, so that its rounding near retro-reflection, where it vanishes, turns
//! both bases alike and drops out.
//!
//! T. A. Germer and E. Marx, Appl. Opt. 43, 1266 (2004).

use crate::{Direction, Incidence, Jones, optics::film::Pair};

/// The projections of w; s and p of each ray are those of positive polar angles at its azimuth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    incoming: [f64; 2],
    outgoing: [f64; 2],
}

impl Turn {
    /// Between the rays (sin θ_i, 0, −cos θ_i) and (sin θ_s cos φ, sin θ_s sin φ, `z`).
    #[inline]
    pub(crate) fn new(incidence: &Incidence, direction: &Direction, z: f64) -> Self {
        let (si, ci) = (incidence.sin, incidence.cos);
        let (so, sin, cos) = (direction.sin, direction.sin_phi, direction.cos_phi);
        let across = so * sin;
        let w = [-across * ci, z * si + so * cos * ci, -across * si];
        Self {
            incoming: [w[1], -across],
            outgoing: [cos * w[1] - sin * w[0], so * w[2] - z * (cos * w[0] + sin * w[1])],
        }
    }

    /// The turn of a facet that is met exactly along its normal: its s is that of the incident ray.
    #[inline]
    pub(crate) fn along_normal(direction: &Direction, z: f64) -> Self {
        Self { incoming: [1.0, 0.0], outgoing: [direction.cos_phi, -z * direction.sin_phi] }
    }

    /// No turn at all.
    pub(crate) fn none() -> Self {
        Self { incoming: [1.0, 0.0], outgoing: [1.0, 0.0] }
    }

    /// |w|⁴, by which intensities of [`Turn::apply`] are too large.
    #[inline]
    pub(crate) fn norm(&self) -> f64 {
        let [c, d] = self.incoming;
        let [cc, dd] = self.outgoing;
        (c * c + d * d) * (cc * cc + dd * dd)
    }

    /// |w|² J for the facet's own `coefficients`.
    #[inline]
    pub(crate) fn apply(&self, coefficients: Pair) -> Jones {
        let Pair { s, p } = coefficients;
        let [c, d] = self.incoming;
        let [cc, dd] = self.outgoing;
        Jones {
            ss: s * (cc * c) + p * (dd * d),
            ps: s * (cc * d) - p * (dd * c),
            sp: s * (dd * c) - p * (cc * d),
            pp: s * (dd * d) + p * (cc * c),
        }
    }
}
