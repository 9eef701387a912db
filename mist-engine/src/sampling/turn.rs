//! How a sensitivity, given at the centre of an aperture, is turned for the other directions.
//!
//! With c the centre and v the direction, both as unit vectors of the upper hemisphere, (s, p)
//! of the centre is carried along to v in the plane of both; β is the angle between the carried
//! pair and (s, p) of v.

use glam::DVec3;

use crate::region::{Angles, unit};

/// Components smaller than this count as zero.
const ZERO: f64 = 1e-10;

/// The turn towards a centre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    center: DVec3,
}

fn is_normal(v: DVec3) -> bool {
    v.x.abs() < ZERO && v.y.abs() < ZERO
}

/// cos 2b and sin 2b of the argument b of x + iy; 1 and 0 for the origin.
fn doubled(x: f64, y: f64) -> (f64, f64) {
    let square = x * x + y * y;
    if square == 0.0 {
        return (1.0, 0.0);
    }
    ((x * x - y * y) / square, 2.0 * x * y / square)
}

impl Turn {
    /// The turn towards the direction `center`.
    pub(crate) fn towards(center: Angles) -> Self {
        Self { center: unit(center) }
    }

    /// cos 2β and sin 2β for the direction `v`.
    pub(crate) fn at(&self, v: DVec3) -> (f64, f64) {
        let c = self.center;
        if (c.x - v.x).abs() < ZERO && (c.y - v.y).abs() < ZERO {
            return (1.0, 0.0);
        }
        if is_normal(c) {
            return doubled(v.x, v.y);
        }
        if is_normal(v) {
            return doubled(c.x, -c.y);
        }
        // β = atan2(at_direction, k) − atan2(at_center, k): the argument of a product.
        let both = c.x * v.x + c.y * v.y;
        let k = c.x * v.y - c.y * v.x;
        let at_center = c.z * both - (c.x * c.x + c.y * c.y) * v.z;
        let at_direction = c.z * (v.x * v.x + v.y * v.y) - both * v.z;
        doubled(k * k + at_center * at_direction, k * (at_direction - at_center))
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
                let (cos, sin) = Turn::towards(c).at(unit(v));
                let b = beta(unit(c), unit(v));
                assert!((cos - (2.0 * b).cos()).abs() < 1e-13, "{c:?} {v:?}");
                assert!((sin - (2.0 * b).sin()).abs() < 1e-13, "{c:?} {v:?}");
            }
        }
    }

    #[test]
    fn nothing_turns_at_the_centre_and_in_the_plane_of_the_normal() {
        let turn = Turn::towards((0.7, 0.4));
        assert_eq!(turn.at(unit((0.7, 0.4))), (1.0, 0.0));
        let (cos, sin) = turn.at(unit((0.3, 0.4)));
        assert!((cos - 1.0).abs() < 1e-12 && sin.abs() < 1e-12);
    }

    #[test]
    fn around_the_normal_the_azimuth_is_the_angle() {
        let (cos, sin) = Turn::towards((0.0, 0.0)).at(unit((0.6, 1.1)));
        assert!((cos - 2.2_f64.cos()).abs() < 1e-15 && (sin - 2.2_f64.sin()).abs() < 1e-15);
        let (cos, sin) = Turn::towards((0.6, 1.1)).at(DVec3::Z);
        assert!((cos - 2.2_f64.cos()).abs() < 1e-15 && (sin + 2.2_f64.sin()).abs() < 1e-15);
    }
}
