//! Rotation of a sensitivity from the centre of an aperture to the other directions.
//!
//! With c the centre and v the direction, both as unit vectors of the upper hemisphere, (s, p)
//! of the centre is carried along to v in the plane of both; β is the angle between the carried
//! pair and (s, p) of v.

use glam::DVec3;
use scattering::lanes::Real;

use crate::region::{PolarAngles, unit};

/// Components smaller than this count as zero.
const ZERO: f64 = 1e-10;

/// The turn towards a centre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SensitivityRotation {
    center: DVec3,
}

/// `usual`, but `special` where x and y count as zero.
#[inline(always)]
fn unless_zero<R: Real>([x, y]: [R; 2], usual: [R; 2], special: [R; 2]) -> [R; 2] {
    let (x, y) = (x.abs() - ZERO, y.abs() - ZERO);
    let (cos, sin) = (y.select(usual[0], special[0]), y.select(usual[1], special[1]));
    [x.select(usual[0], cos), x.select(usual[1], sin)]
}

/// cos 2b and sin 2b of the argument b of x + iy; 1 and 0 for the origin.
#[inline(always)]
fn doubled<R: Real>(x: R, y: R) -> [R; 2] {
    let square = x * x + y * y;
    let is_zero = -square;
    let per_square = x.splat(1.0) / square;
    let doubled = [(x * x - y * y) * per_square, x * y * 2.0 * per_square];
    [is_zero.select(x.splat(1.0), doubled[0]), is_zero.select(x.splat(0.0), doubled[1])]
}

impl SensitivityRotation {
    /// The turn towards the direction `center`.
    pub(crate) fn towards(center: PolarAngles) -> Self {
        Self { center: unit(center) }
    }

    /// cos 2β and sin 2β for the direction with the unit vector (x, y, z), or for several.
    #[inline(always)]
    pub(crate) fn at<R: Real>(&self, [x, y, z]: [R; 3]) -> [R; 2] {
        let c = self.center;
        let turned = if c.x.abs() < ZERO && c.y.abs() < ZERO {
            doubled(x, y)
        } else {
            // β = atan2(at_direction, k) − atan2(at_center, k): the argument of a product.
            let both = x * c.x + y * c.y;
            let k = y * c.x - x * c.y;
            let at_center = both * c.z - z * (c.x * c.x + c.y * c.y);
            let at_direction = (x * x + y * y) * c.z - both * z;
            let usual = doubled(k * k + at_center * at_direction, k * (at_direction - at_center));
            let [cos, sin] = doubled(c.x, -c.y);
            unless_zero([x, y], usual, [x.splat(cos), x.splat(sin)])
        };
        unless_zero([x - c.x, y - c.y], turned, [x.splat(1.0), x.splat(0.0)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The angle itself, as the specification has it.
    fn beta(c: DVec3, v: DVec3) -> f64 {
        let k = c.x * v.y - c.y * v.x;
        let both = c.x * v.x + c.y * v.y;
        -(c.z * both - (c.x * c.x + c.y * c.y) * v.z).atan2(k)
            + (c.z * (v.x * v.x + v.y * v.y) - both * v.z).atan2(k)
    }

    #[test]
    fn doubled_angles_are_those_of_the_formula() {
        for c in [(0.3, 0.2), (1.2, -2.0), (0.8, 3.0)] {
            for v in [(0.5, 1.0), (1.5, -1.9), (0.05, 2.8), (0.8, 0.1), (0.8, -0.14159)] {
                let [cos, sin] = SensitivityRotation::towards(c).at(unit(v).to_array());
                let b = beta(unit(c), unit(v));
                assert!((cos - (2.0 * b).cos()).abs() < 1e-13, "{c:?} {v:?}");
                assert!((sin - (2.0 * b).sin()).abs() < 1e-13, "{c:?} {v:?}");
            }
        }
    }

    #[test]
    fn nothing_turns_at_the_centre_and_in_the_plane_of_the_normal() {
        let turn = SensitivityRotation::towards((0.7, 0.4));
        assert_eq!(turn.at(unit((0.7, 0.4)).to_array()), [1.0, 0.0]);
        let [cos, sin] = turn.at(unit((0.3, 0.4)).to_array());
        assert!((cos - 1.0).abs() < 1e-12 && sin.abs() < 1e-12);
    }

    #[test]
    fn around_the_normal_the_azimuth_is_the_angle() {
        let [cos, sin] = SensitivityRotation::towards((0.0, 0.0)).at(unit((0.6, 1.1)).to_array());
        assert!((cos - 2.2_f64.cos()).abs() < 1e-15 && (sin - 2.2_f64.sin()).abs() < 1e-15);
        let [cos, sin] = SensitivityRotation::towards((0.6, 1.1)).at([0.0, 0.0, 1.0]);
        assert!((cos - 2.2_f64.cos()).abs() < 1e-15 && (sin + 2.2_f64.sin()).abs() < 1e-15);
    }
}
