//! The Jones matrix of a tilted facet: rotation from its own s and p to those of the two rays.
//!
//! The facet's s direction is perpendicular to both rays, along w = k_o × k_i. With
//!
//! $$ c = w\cdot s_i,\quad d = w\cdot p_i,\quad C = w\cdot s_o,\quad D = w\cdot p_o, \qquad
//!    c^2+d^2 = C^2+D^2 = |w|^2 \qquad (1) $$
//!
//! $$ J = \frac{1}{|w|^2} \begin{pmatrix} C & -D \\ D & C \end{pmatrix}
//!    \begin{pmatrix} r_s & 0 \\ 0 & r_p \end{pmatrix}
//!    \begin{pmatrix} c & d \\ -d & c \end{pmatrix} \qquad (2) $$
//!
//! For reflection |w| = sin 2ι and the elements are the published q_ij/a₁. w vanishes at
//! retro-reflection. It is computed once and projected on both bases: its rounding errors rotate
//! both bases equally and cancel.
//!
//! T. A. Germer and E. Marx, Appl. Opt. 43, 1266 (2004).

use crate::{
    Direction, Incidence, Jones,
    geometry::ScatteredRay,
    lanes::{Complex, Real},
    optics::film::SpAmplitudes,
};

/// The facets that reflect a beam into one direction or a batch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FacetOrientation<R> {
    /// |h|², h = k_o − k_i along their normals: 4 cos² ι.
    h2: R,
    /// h_z².
    z2: R,
    /// sin² ι.
    pub(crate) sin2: R,
    /// Their slopes in the frame of the sample.
    pub(crate) slopes: [R; 2],
}

impl<R: Real> FacetOrientation<R> {
    #[inline(always)]
    pub(crate) fn between(incidence: &Incidence, to: &ScatteredRay<R>) -> Self {
        let (kx, ky) = (to.sin * to.cos_phi, to.sin * to.sin_phi);
        let length_squared = |x: R, z: R| x * x + ky * ky + z * z;
        let (hx, hz) = (kx - incidence.sin, to.cos + incidence.cos);
        // |k_o + k_i| = 2 sin ι.
        let sin2 = length_squared(kx + incidence.sin, to.cos - incidence.cos) * 0.25;
        let per_hz = hz.splat(1.0) / hz;
        let (x, y) = (hx * per_hz, ky * per_hz);
        let (sin, cos) = (incidence.sin_rotation, incidence.cos_rotation);
        Self {
            h2: length_squared(hx, hz),
            z2: hz * hz,
            sin2,
            slopes: [x * cos + y * sin, y * cos - x * sin],
        }
    }

    /// cos ι.
    #[inline(always)]
    pub(crate) fn cos(&self) -> R {
        self.h2.sqrt() * 0.5
    }

    /// S/(n_z⁴ x) for the density S of the slopes.
    #[inline(always)]
    pub(crate) fn weight(&self, density: R, x: R) -> R {
        density * (self.h2 * self.h2) / (self.z2 * self.z2 * x)
    }
}

/// The projections of w; s and p of each ray are those of positive polar angles at its azimuth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FacetRotation<R> {
    incoming: [R; 2],
    outgoing: [R; 2],
}

impl<R: Real> FacetRotation<R> {
    /// Between the rays (sin θ_i, 0, −cos θ_i) and (sin θ_s cos φ, sin θ_s sin φ, `z`).
    #[inline(always)]
    pub(crate) fn new(incidence: &Incidence, to: &ScatteredRay<R>, z: R) -> Self {
        let (si, ci) = (incidence.sin, incidence.cos);
        let (so, sin, cos) = (to.sin, to.sin_phi, to.cos_phi);
        let across = so * sin;
        // w = k_o × k_i and its projections (1).
        let w = [-across * ci, z * si + so * cos * ci, -across * si];
        Self {
            incoming: [w[1], -across],
            outgoing: [cos * w[1] - sin * w[0], so * w[2] - z * (cos * w[0] + sin * w[1])],
        }
    }

    /// |w|⁴, by which intensities of [`FacetRotation::apply`] are too large.
    #[inline(always)]
    pub(crate) fn norm(&self) -> R {
        let [c, d] = self.incoming;
        let [cc, dd] = self.outgoing;
        (c * c + d * d) * (cc * cc + dd * dd)
    }

    /// The elements ss, ps, sp and pp of |w|² J for the facet's own coefficients of s and p.
    #[inline(always)]
    pub(crate) fn elements(&self, [s, p]: [Complex<R>; 2]) -> [Complex<R>; 4] {
        let [c, d] = self.incoming;
        let [cc, dd] = self.outgoing;
        // (2)
        [
            s * (cc * c) + p * (dd * d),
            s * (cc * d) - p * (dd * c),
            s * (dd * c) - p * (cc * d),
            s * (dd * d) + p * (cc * c),
        ]
    }
}

impl FacetRotation<f64> {
    /// The rotation at exactly normal incidence on the facet: its s is that of the incident ray.
    #[inline]
    pub(crate) fn along_normal(direction: &Direction, z: f64) -> Self {
        Self { incoming: [1.0, 0.0], outgoing: [direction.cos_phi, -z * direction.sin_phi] }
    }

    /// The identity.
    pub(crate) fn none() -> Self {
        Self { incoming: [1.0, 0.0], outgoing: [1.0, 0.0] }
    }

    /// |w|² J for the facet's own `coefficients`.
    #[inline]
    pub(crate) fn apply(&self, coefficients: SpAmplitudes) -> Jones {
        let SpAmplitudes { s, p } = coefficients;
        let [ss, ps, sp, pp] = self.elements([s.into(), p.into()]).map(Into::into);
        Jones { ss, ps, sp, pp }
    }
}
