//! Rotation of Stokes vectors to another basis of the same beam.

use glam::DVec3;
use scattering::Stokes;

/// The rotation from one basis {s, p, k} of a beam to another.
///
/// Cosine and sine are those of twice the angle from the old s to the new s, positive towards the
/// old p.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StokesRotation {
    cos: f64,
    sin: f64,
}

impl StokesRotation {
    /// The identity.
    pub(crate) const IDENTITY: Self = Self { cos: 1.0, sin: 0.0 };

    /// The rotation from the basis whose s is `from` to the basis whose s is `to`; both are unit
    /// vectors perpendicular to the beam direction `k`.
    pub(crate) fn between(k: DVec3, from: DVec3, to: DVec3) -> Self {
        let (cos, sin) = (to.dot(from), to.dot(k.cross(from)));
        Self { cos: cos * cos - sin * sin, sin: 2.0 * sin * cos }
    }

    /// The vector in the new basis.
    pub(crate) fn apply(self, Stokes([i, q, u, v]): Stokes) -> Stokes {
        Stokes([i, self.cos * q + self.sin * u, self.cos * u - self.sin * q, v])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_along_s_and_p_is_along_a_basis_at_45_degrees() {
        let (k, s) = (DVec3::Z, DVec3::X);
        let diagonal = (DVec3::X + DVec3::Y).normalize();
        let turned = StokesRotation::between(k, s, diagonal).apply(Stokes([1.0, 0.0, 0.8, 0.3]));
        for (found, expected) in turned.0.iter().zip([1.0, 0.8, 0.0, 0.3]) {
            assert!((found - expected).abs() < 1e-15, "{turned:?}");
        }
    }

    #[test]
    fn a_basis_turned_half_around_is_the_same() {
        let light = Stokes([1.0, 0.1, 0.2, 0.3]);
        assert_eq!(StokesRotation::between(DVec3::Z, DVec3::X, -DVec3::X).apply(light), light);
    }
}
