//! Exact projected areas of intersections of cones with the upper hemisphere.
//!
//! The boundary of such an intersection consists of arcs of circles on the sphere. By Green's
//! theorem its projected area is the sum over the arcs of ½∫(x dy − y dx), which has a closed
//! form because x and y are linear in cos t and sin t along a circle.

use std::f64::consts::TAU;

use glam::DVec3;

use super::direction::{PolarAngles, unit};

/// All directions within a half angle of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cap {
    axis: DVec3,
    cos: f64,
    sin: f64,
}

/// Two circles closer than this are the same.
const SAME: f64 = 1e-13;

impl Cap {
    /// The cap of half angle |`alpha`|, at most π.
    pub(super) fn new(center: PolarAngles, alpha: f64) -> Self {
        let (sin, cos) = alpha.abs().min(std::f64::consts::PI).sin_cos();
        Self { axis: unit(center), cos, sin }
    }

    /// Everything above the horizon.
    fn upper() -> Self {
        Self { axis: DVec3::Z, cos: 0.0, sin: 1.0 }
    }

    fn holds(&self, v: DVec3) -> bool {
        self.axis.dot(v) > self.cos
    }

    fn is_same(&self, other: &Self) -> bool {
        (self.axis - other.axis).length() < SAME && (self.cos - other.cos).abs() < SAME
    }

    /// Two unit vectors across the axis; the circle runs from the first to the second,
    /// counter-clockwise about the axis.
    fn across(&self) -> (DVec3, DVec3) {
        let q = self.axis.any_orthonormal_vector();
        (q, self.axis.cross(q))
    }

    /// The parameters t in 0..2π, in order, at which the circle crosses that of `other`.
    fn crossings(&self, other: &Self) -> Vec<f64> {
        let (q, p) = self.across();
        let (b, c) = (self.sin * q.dot(other.axis), self.sin * p.dot(other.axis));
        let cosine = (other.cos - self.cos * self.axis.dot(other.axis)) / b.hypot(c);
        if cosine.is_nan() || cosine.abs() >= 1.0 {
            return Vec::new();
        }
        let (middle, half) = (c.atan2(b), cosine.acos());
        vec![(middle - half).rem_euclid(TAU), (middle + half).rem_euclid(TAU)]
    }

    fn at(&self, t: f64) -> DVec3 {
        let (q, p) = self.across();
        self.axis * self.cos + (q * t.cos() + p * t.sin()) * self.sin
    }

    /// ½∫(x dy − y dx) along the circle from `from` to `to`.
    fn swept(&self, from: f64, to: f64) -> f64 {
        let (q, p) = self.across();
        let (m, q, p) = (self.axis * self.cos, q * self.sin, p * self.sin);
        let sines = (m.x * p.y - m.y * p.x) * (to.sin() - from.sin());
        let cosines = (m.x * q.y - m.y * q.x) * (to.cos() - from.cos());
        0.5 * (sines + cosines + (q.x * p.y - p.x * q.y) * (to - from))
    }
}

/// The projected area (sr) of what all of `caps` and the upper hemisphere share.
pub(super) fn area(caps: &[Cap]) -> f64 {
    let mut distinct = vec![Cap::upper()];
    for cap in caps {
        if !distinct.iter().any(|c| c.is_same(cap)) {
            distinct.push(*cap);
        }
    }
    (0..distinct.len()).map(|k| boundary(k, &distinct)).sum()
}

/// The part that the circle of cap `k` contributes.
fn boundary(k: usize, caps: &[Cap]) -> f64 {
    let circle = &caps[k];
    let others = || caps.iter().enumerate().filter(|(m, _)| *m != k).map(|(_, cap)| cap);
    let mut ends: Vec<f64> = others().flat_map(|cap| circle.crossings(cap)).collect();
    ends.sort_by(f64::total_cmp);
    let Some(first) = ends.first().copied() else {
        ends = vec![0.0, TAU];
        return arcs(circle, &ends, others);
    };
    ends.push(first + TAU);
    arcs(circle, &ends, others)
}

fn arcs<'a, I: Iterator<Item = &'a Cap>>(
    circle: &Cap,
    ends: &[f64],
    others: impl Fn() -> I,
) -> f64 {
    let inside = |t: f64| {
        let v = circle.at(t);
        others().all(|cap| cap.holds(v))
    };
    ends.windows(2)
        .filter(|arc| inside(0.5 * (arc[0] + arc[1])))
        .map(|arc| circle.swept(arc[0], arc[1]))
        .sum()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    /// The same area by a midpoint rule over the plane.
    fn counted(caps: &[Cap], n: i32) -> f64 {
        let h = 1.0 / f64::from(n);
        let mut inside = 0;
        for i in -n..n {
            for j in -n..n {
                let (x, y) = ((f64::from(i) + 0.5) * h, (f64::from(j) + 0.5) * h);
                let v = DVec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt());
                inside += i32::from(x * x + y * y < 1.0 && caps.iter().all(|c| c.holds(v)));
            }
        }
        f64::from(inside) * h * h
    }

    #[test]
    fn a_cone_above_the_horizon_has_the_area_of_its_ellipse() {
        for (theta, alpha) in [(0.0, 0.3), (0.7, 0.5), (1.2, 0.3), (0.4, 1.1)] {
            let got = area(&[Cap::new((theta, 2.1), alpha)]);
            let want = PI * f64::sin(alpha).powi(2) * f64::cos(theta);
            assert!((got - want).abs() < 1e-14, "{got} is not {want}");
        }
    }

    #[test]
    fn a_cone_that_covers_the_hemisphere_has_area_pi() {
        assert!((area(&[Cap::new((0.0, 0.0), FRAC_PI_2)]) - PI).abs() < 1e-14);
        assert!((area(&[Cap::new((0.5, 1.0), 2.5)]) - PI).abs() < 1e-14);
        assert!((area(&[Cap::new((0.5, 1.0), 4.0)]) - PI).abs() < 1e-14);
    }

    #[test]
    fn half_a_cone_on_the_horizon_has_the_area_of_its_segment() {
        // The projection of the cone around the x axis is the part x > cos α of the disk.
        let alpha = 0.6_f64;
        let want = alpha - alpha.sin() * alpha.cos();
        assert!((area(&[Cap::new((FRAC_PI_2, 0.0), alpha)]) - want).abs() < 1e-14);
        assert_eq!(area(&[Cap::new((2.5, 0.0), 0.6)]), 0.0);
    }

    #[test]
    fn lenses_and_cut_cones_agree_with_a_count() {
        // The count has 2e6 cells; its boundary cells make an error of about 1e-5.
        let cases = [
            vec![Cap::new((1.3, 0.4), 0.5)],
            vec![Cap::new((0.3, 0.4), 0.5), Cap::new((0.8, 0.9), 0.4)],
            vec![Cap::new((1.2, 0.0), 0.7), Cap::new((1.4, 0.5), 0.6)],
            vec![Cap::new((0.3, 0.4), 0.5), Cap::new((0.35, 0.3), 0.1)],
            vec![Cap::new((0.3, 0.4), 0.2), Cap::new((1.1, -1.0), 0.2)],
            vec![Cap::new((1.0, 0.4), 1.8), Cap::new((0.2, 2.0), 1.4)],
        ];
        for caps in cases {
            let (got, want) = (area(&caps), counted(&caps, 700));
            assert!((got - want).abs() < 5e-5, "{got} is not {want}");
        }
    }
}
