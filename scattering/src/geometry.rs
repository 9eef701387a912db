//! The directions of a scattering event, and how they are turned into vectors.
//!
//! The sample lies in the plane z = 0 with its outward normal along +z. Light comes from −x:
//! the specular direction of an incident polar angle θ_i is (θ_s, φ_s) = (θ_i, 0), and
//! retro-reflection is at φ_s = π.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;

use crate::{
    Mode,
    lanes::{SimdLevel, WIDTH},
    polarization::{BeamPair, is_normal},
};

/// The four angles of one evaluation, in radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Geometry {
    /// Polar angle of incidence.
    pub theta_i: f64,
    /// Polar angle of scattering.
    pub theta_s: f64,
    /// Azimuth of scattering; 0 is the forward (specular) half plane.
    pub phi_s: f64,
    /// Azimuth of the sample's own x axis, counter-clockwise seen from outside.
    pub rotation: f64,
}

/// Which side of the surface the light comes from and goes to; the parameter `type` of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Type 0: reflection, source outside.
    DownUp,
    /// Type 1: transmission into the substrate; θ_s is the internal angle.
    DownDown,
    /// Type 2: internal reflection; both angles are internal.
    UpDown,
    /// Type 3: transmission out of the substrate; θ_i is the internal angle.
    UpUp,
}

impl Side {
    /// The side of NIST's numbering 0–3, or nothing for any other number.
    pub fn from_type(number: i32) -> Option<Self> {
        [Self::DownUp, Self::DownDown, Self::UpDown, Self::UpUp]
            .get(usize::try_from(number).ok()?)
            .copied()
    }

    /// NIST's number of this side, 0–3.
    pub fn number(self) -> i32 {
        self as i32
    }

    /// True if the incident light travels upwards, inside the substrate.
    pub fn from_below(self) -> bool {
        matches!(self, Self::UpDown | Self::UpUp)
    }

    /// True if the scattered light travels downwards, inside the substrate.
    pub fn to_below(self) -> bool {
        matches!(self, Self::DownDown | Self::UpDown)
    }
}

/// An angle (radians) that most formulas need only by its sine and cosine: the number that was
/// given, or NaN where it follows from those two.
#[derive(Clone, Copy, Debug)]
struct Angle(f64);

impl Angle {
    const FOLLOWS: Self = Self(f64::NAN);

    fn radians(self, sin: f64, cos: f64) -> f64 {
        if self.0.is_nan() { sin.atan2(cos) } else { self.0 }
    }

    /// True if it is less than π/2 from the normal.
    fn is_above(self, cos: f64) -> bool {
        // The largest cosine whose angle rounds to π/2.
        const HORIZON: f64 = 1.722_546_424_198_833e-16;
        (self.0.abs() < FRAC_PI_2) | (self.0.is_nan() & (cos > HORIZON))
    }
}

/// True if the polar angle that follows from this cosine is less than π/2.
pub fn is_above(cos: f64) -> bool {
    Angle::FOLLOWS.is_above(cos)
}

/// An incident beam and the orientation of the sample: what a batch of directions shares.
#[derive(Clone, Copy, Debug)]
pub struct Incidence {
    theta: Angle,
    /// sin θ_i.
    pub sin: f64,
    /// cos θ_i.
    pub cos: f64,
    rotation: Angle,
    /// sin of the rotation.
    pub sin_rotation: f64,
    /// cos of the rotation.
    pub cos_rotation: f64,
}

impl Incidence {
    /// A beam at polar angle `theta` on a sample turned by `rotation`, both in radians.
    pub fn new(theta: f64, rotation: f64) -> Self {
        let (sin, cos) = theta.sin_cos();
        let (sin_rotation, cos_rotation) = rotation.sin_cos();
        let (theta, rotation) = (Angle(theta), Angle(rotation));
        Self { theta, sin, cos, rotation, sin_rotation, cos_rotation }
    }

    /// The beam whose polar angle and rotation have these sines and cosines.
    pub fn from_sin_cos(theta: (f64, f64), rotation: (f64, f64)) -> Self {
        let ((sin, cos), (sin_rotation, cos_rotation)) = (theta, rotation);
        let follows = Angle::FOLLOWS;
        Self { theta: follows, sin, cos, rotation: follows, sin_rotation, cos_rotation }
    }

    /// The beam on the same sample whose polar angle has this sine and cosine.
    pub(crate) fn inclined(&self, (sin, cos): (f64, f64)) -> Self {
        Self { theta: Angle::FOLLOWS, sin, cos, ..*self }
    }

    /// Polar angle of incidence, radians.
    pub fn theta(&self) -> f64 {
        self.theta.radians(self.sin, self.cos)
    }

    /// Sample rotation, radians.
    pub fn rotation(&self) -> f64 {
        self.rotation.radians(self.sin_rotation, self.cos_rotation)
    }

    /// True if the polar angle is less than π/2.
    pub fn is_above(&self) -> bool {
        self.theta.is_above(self.cos)
    }

    /// Propagation vector of type 0 light, (sin θ, 0, −cos θ).
    pub fn k(&self) -> DVec3 {
        DVec3::new(self.sin, 0.0, -self.cos)
    }

    /// s of the beam: ŷ.
    pub fn s(&self) -> DVec3 {
        DVec3::Y
    }

    /// A lateral vector of the laboratory (slope, spatial frequency) as the sample sees it.
    pub fn to_sample(&self, x: f64, y: f64) -> (f64, f64) {
        (
            x * self.cos_rotation + y * self.sin_rotation,
            y * self.cos_rotation - x * self.sin_rotation,
        )
    }
}

/// A direction of scattering with the sines and cosines that every model needs.
#[derive(Clone, Copy, Debug)]
pub struct Direction {
    theta: Angle,
    phi: Angle,
    /// sin θ_s.
    pub sin: f64,
    /// cos θ_s.
    pub cos: f64,
    /// sin φ_s.
    pub sin_phi: f64,
    /// cos φ_s.
    pub cos_phi: f64,
}

impl Direction {
    /// The direction with polar angle `theta` and azimuth `phi`, radians.
    pub fn new(theta: f64, phi: f64) -> Self {
        let (sin, cos) = theta.sin_cos();
        let (sin_phi, cos_phi) = phi.sin_cos();
        Self { theta: Angle(theta), phi: Angle(phi), sin, cos, sin_phi, cos_phi }
    }

    /// The direction whose polar angle and azimuth have these sines and cosines.
    pub fn from_sin_cos(theta: (f64, f64), phi: (f64, f64)) -> Self {
        let ((sin, cos), (sin_phi, cos_phi)) = (theta, phi);
        Self { theta: Angle::FOLLOWS, phi: Angle::FOLLOWS, sin, cos, sin_phi, cos_phi }
    }

    /// The direction of the same azimuth whose polar angle has this sine and cosine.
    pub(crate) fn inclined(&self, (sin, cos): (f64, f64)) -> Self {
        Self { theta: Angle::FOLLOWS, sin, cos, ..*self }
    }

    /// Polar angle, radians; may be negative.
    pub fn theta(&self) -> f64 {
        self.theta.radians(self.sin, self.cos)
    }

    /// Azimuth, radians.
    pub fn phi(&self) -> f64 {
        self.phi.radians(self.sin_phi, self.cos_phi)
    }

    /// True if the polar angle is less than π/2 on either side of the normal.
    pub fn is_above(&self) -> bool {
        self.theta.is_above(self.cos)
    }

    /// Propagation vector of type 0 light, (sin θ cos φ, sin θ sin φ, cos θ).
    pub fn k(&self) -> DVec3 {
        DVec3::new(self.sin * self.cos_phi, self.sin * self.sin_phi, self.cos)
    }

    /// s of the beam: ẑ × k of positive polar angles at its azimuth, which is the limit of them
    /// for a beam along the normal.
    pub fn s(&self) -> DVec3 {
        DVec3::new(-self.sin_phi, self.cos_phi, 0.0)
    }

    /// s of the beam as NIST's library takes it from k: ŷ along the normal, whatever the azimuth
    /// ([`Defect::NormalBasis`](crate::Defect::NormalBasis)).
    pub(crate) fn nists_s(&self) -> DVec3 {
        let k = self.k();
        if is_normal(k) { DVec3::Y } else { self.s() }
    }
}

impl Geometry {
    /// The incident half of the geometry.
    pub fn incidence(&self) -> Incidence {
        Incidence::new(self.theta_i, self.rotation)
    }

    /// The scattered half of the geometry.
    pub fn direction(&self) -> Direction {
        Direction::new(self.theta_s, self.phi_s)
    }
}

/// The beams of an event on `side`, for a change of basis.
pub(crate) fn beams(
    side: Side,
    incidence: &Incidence,
    direction: &Direction,
    mode: Mode,
) -> BeamPair {
    let (k_i, k_s) = propagation(side, incidence, direction);
    let s = match mode {
        Mode::Sound => direction.s(),
        Mode::Compat => direction.nists_s(),
    };
    BeamPair { k: [k_i, k_s], s: [incidence.s(), s] }
}

/// Propagation vectors (incident, scattered) with the z components that belong to `side`.
pub fn propagation(side: Side, incidence: &Incidence, direction: &Direction) -> (DVec3, DVec3) {
    let (mut k_i, mut k_s) = (incidence.k(), direction.k());
    if side.from_below() {
        k_i.z = -k_i.z;
    }
    if side.to_below() {
        k_s.z = -k_s.z;
    }
    (k_i, k_s)
}

/// A scattered direction, or a batch of them: sines and cosines of [`Direction`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScatteredRay<R> {
    pub(crate) sin: R,
    pub(crate) cos: R,
    pub(crate) sin_phi: R,
    pub(crate) cos_phi: R,
}

impl ScatteredRay<f64> {
    #[inline]
    pub(crate) fn single(direction: &Direction) -> Self {
        let &Direction { sin, cos, sin_phi, cos_phi, .. } = direction;
        Self { sin, cos, sin_phi, cos_phi }
    }
}

impl<R> ScatteredRay<R> {
    #[inline(always)]
    pub(crate) fn batch(
        vectors: impl SimdLevel<Vector = R>,
        directions: &[Direction; WIDTH],
    ) -> Self {
        let each = |f: fn(&Direction) -> f64| vectors.load(&directions.each_ref().map(f));
        Self {
            sin: each(|d| d.sin),
            cos: each(|d| d.cos),
            sin_phi: each(|d| d.sin_phi),
            cos_phi: each(|d| d.cos_phi),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_that_follow_from_sines_and_cosines_are_above_where_they_round_below_half_pi() {
        for k in 0..200 {
            let cos = 1e-18 * f64::from(k * k);
            let to = Direction::from_sin_cos((1.0, cos), (0.0, 1.0));
            assert_eq!(to.is_above(), to.theta() < FRAC_PI_2, "{cos:e}");
        }
    }

    #[test]
    fn angles_that_were_given_are_kept_beyond_a_turn() {
        let to = Direction::new(7.0, -9.0);
        assert_eq!((to.theta(), to.phi(), to.is_above()), (7.0, -9.0, false));
        assert!(!Direction::new(f64::NAN, 0.0).is_above());
    }
}
