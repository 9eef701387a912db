//! Stokes vectors seen in another basis of the same beam.

use glam::DVec3;
use scattering::Stokes;

/// The change from one basis {s, p, k} of a beam to another: cosine and sine of twice the angle
/// from the old s to the new one, counted towards the old p.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Turn {
    cos: f64,
    sin: f64,
}

impl Turn {
    /// No change.
    pub(super) const NONE: Self = Self { cos: 1.0, sin: 0.0 };

    /// From the basis with `from` to the one with `to`, unit vectors across the beam along `k`.
    pub(super) fn between(k: DVec3, from: DVec3, to: DVec3) -> Self {
        let (cos, sin) = (to.dot(from), to.dot(k.cross(from)));
        Self { cos: cos * cos - sin * sin, sin: 2.0 * sin * cos }
    }

    /// The vector in the new basis.
    pub(super) fn apply(self, Stokes([i, q, u, v]): Stokes) -> Stokes {
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
        let turned = Turn::between(k, s, diagonal).apply(Stokes([1.0, 0.0, 0.8, 0.3]));
        for (found, expected) in turned.0.iter().zip([1.0, 0.8, 0.0, 0.3]) {
            assert!((found - expected).abs() < 1e-15, "{turned:?}");
        }
    }

    #[test]
    fn a_basis_turned_half_around_is_the_same() {
        let light = Stokes([1.0, 0.1, 0.2, 0.3]);
        assert_eq!(Turn::between(DVec3::Z, DVec3::X, -DVec3::X).apply(light), light);
    }
}
