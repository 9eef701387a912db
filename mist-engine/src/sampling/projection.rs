//! Projections of a disk onto a cone around the normal.

use glam::{DVec2, DVec3};
use scattering::lanes::Real;

/// A projection of the plane onto the sphere: a point at the distance ρ from the origin gets the
/// polar angle t.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Projection {
    /// t = ρ.
    Equidistant,
    /// 1 − cos t = ρ²: equal areas stay equal.
    EqualArea,
    /// sin t = ρ.
    Orthographic,
}

/// Closer to a horizon than this, sines and cosines are taken of angles, as NIST's program does:
/// whether a point is kept can depend on their rounding.
const DELICATE: f64 = 1e-9;

impl Projection {
    /// `equidistant`, `equal_area` or `orthographic`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Equidistant => "equidistant",
            Self::EqualArea => "equal_area",
            Self::Orthographic => "orthographic",
        }
    }

    /// Solid angle per area of the plane at the centre.
    pub(super) fn area_per_area(self) -> f64 {
        if self == Self::EqualArea { 2.0 } else { 1.0 }
    }

    /// The radius of the disk that covers polar angles up to `alpha`.
    pub(super) fn radius(self, alpha: f64) -> f64 {
        match self {
            Self::Equidistant => alpha,
            Self::EqualArea => (1.0 - alpha.cos()).sqrt(),
            Self::Orthographic => alpha.sin(),
        }
    }

    /// The unit vector of a point, and the weight that makes up for the projection; or those of
    /// several points.
    #[inline(always)]
    pub(super) fn lift<R: Real>(self, x: R, y: R) -> ([R; 3], R) {
        let z2 = x * x + y * y;
        match self {
            Self::Equidistant => {
                let t = z2.sqrt();
                let (sin, cos) = t.sin_cos();
                let weight = (-t).select(t.splat(1.0), sin / t);
                ([x * weight, y * weight, cos], weight)
            }
            Self::EqualArea => {
                let square = -z2 + 2.0;
                let stretch = square.select(square, z2.splat(0.0)).sqrt();
                ([x * stretch, y * stretch, -z2 + 1.0], z2.splat(1.0))
            }
            Self::Orthographic => {
                let z = (-z2 + 1.0).sqrt();
                ([x, y, z], z.splat(1.0) / z)
            }
        }
    }

    /// [`Projection::lift`] by way of the polar angles.
    pub(super) fn lift_by_angles(self, p: DVec2) -> (DVec3, f64) {
        let z2 = p.x * p.x + p.y * p.y;
        let t = match self {
            Self::Equidistant => z2.sqrt(),
            Self::EqualArea => (1.0 - z2).acos(),
            Self::Orthographic => z2.sqrt().asin(),
        };
        let weight = match self {
            Self::Equidistant if t == 0.0 => 1.0,
            Self::Equidistant => t.sin() / t,
            Self::EqualArea => 1.0,
            Self::Orthographic => 1.0 / t.cos(),
        };
        (crate::region::unit((t, p.y.atan2(p.x))), weight)
    }

    /// Not negative where rounding does not decide about the point (x, y) of the plane that is lifted
    /// to a direction with the z component `z`, and about its weight; or about several points.
    #[inline(always)]
    pub(super) fn clearance<R: Real>(self, [x, y]: [R; 2], z: R) -> R {
        let to_horizon = z.abs() - DELICATE;
        match self {
            Self::Equidistant | Self::EqualArea => to_horizon,
            Self::Orthographic => {
                let to_rim = -(x * x + y * y) + 1.0 - DELICATE;
                to_rim.select(to_horizon, to_rim)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Projection; 3] =
        [Projection::Equidistant, Projection::EqualArea, Projection::Orthographic];

    #[test]
    fn both_ways_to_lift_a_point_agree() {
        for projection in ALL {
            for (x, y) in [(0.0, 0.0), (0.1, -0.2), (-0.7, 0.3), (0.5, 0.8), (0.0, -0.9)] {
                let (u, w) = projection.lift(x, y);
                let u = DVec3::from_array(u);
                let (v, by_angles) = projection.lift_by_angles(DVec2::new(x, y));
                assert!((u - v).length() < 1e-15 && (w / by_angles - 1.0).abs() < 1e-14);
                assert!((u.length() - 1.0).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn the_radius_is_where_the_rim_of_the_cone_lies() {
        for projection in ALL {
            let (u, _) = projection.lift(projection.radius(0.8), 0.0);
            assert!((u[2] - 0.8_f64.cos()).abs() < 1e-15);
        }
    }
}
