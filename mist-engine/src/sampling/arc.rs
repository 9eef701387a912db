//! The angle of a point, fast: layouts need two for every direction.
//!
//! The standard function is exact to half a unit of the last place and takes some hundred
//! operations; this one is off by at most three units and takes thirty, without a branch that the
//! points of a grid would mispredict.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, SQRT_2};

/// (arc tan t)/t as a polynomial in t² for |t| ≤ tan π/8, from the lowest power on: the Chebyshev
/// interpolation of degree 11, which is off by 1.3e-18.
const SERIES: [f64; 12] = [
    1.0,
    -0.3333333333333312,
    0.19999999999940893,
    -0.14285714279250245,
    0.11111110744919658,
    -0.09090896809064027,
    0.07692045330902225,
    -0.06662951813629191,
    0.05846878297330872,
    -0.05035102456601552,
    0.03796525745386593,
    -0.017805397205419446,
];

/// The angle from −π to π between the x axis and the point (x, y), not both of them 0.
#[inline]
pub(super) fn angle(y: f64, x: f64) -> f64 {
    let (across, along) = (y.abs(), x.abs());
    let (low, high) = (across.min(along), across.max(along));
    // Beyond tan π/8 the angle to the diagonal: tan(a − π/4) = (tan a − 1)/(tan a + 1).
    let near_diagonal = low > (SQRT_2 - 1.0) * high;
    let (above, below, turn) =
        if near_diagonal { (low - high, low + high, FRAC_PI_4) } else { (low, high, 0.0) };
    let t = above / below;
    let t2 = t * t;
    let t4 = t2 * t2;
    // Even and odd powers of t² apart: they do not wait for each other.
    let (mut even, mut odd) = (SERIES[10], SERIES[11]);
    for k in (0..5).rev() {
        even = even * t4 + SERIES[2 * k];
        odd = odd * t4 + SERIES[2 * k + 1];
    }
    let eighth = turn + t * (even + t2 * odd);
    let quarter = if across > along { FRAC_PI_2 - eighth } else { eighth };
    let half = if x < 0.0 { PI - quarter } else { quarter };
    half.copysign(y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_those_of_the_standard_library_but_for_three_units_of_the_last_place() {
        for i in -600..=600 {
            for size in [1.0, 1e-3, 1e-12] {
                let a = f64::from(i) * PI / 600.0 * 0.999_999;
                let (y, x) = (size * a.sin(), size * a.cos());
                let exact = y.atan2(x);
                let off = (angle(y, x) - exact).abs();
                assert!(off <= 3.0 * f64::EPSILON * exact.abs().max(1e-300), "{a}: {off:e}");
            }
        }
    }

    #[test]
    fn the_axes_and_diagonals_have_their_angles() {
        assert_eq!(angle(0.0, 1.0), 0.0);
        assert_eq!(angle(1.0, 0.0), FRAC_PI_2);
        assert_eq!(angle(-1.0, 0.0), -FRAC_PI_2);
        assert_eq!(angle(0.0, -1.0), PI);
        assert_eq!(angle(1.0, 1.0), FRAC_PI_4);
        assert_eq!(angle(-2.0, -2.0), -3.0 * FRAC_PI_4);
    }
}
