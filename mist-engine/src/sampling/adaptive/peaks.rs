//! Widths of the peaks of an integrand, from a few evaluations around the likely places.
//!
//! Rings of radii r₀, 3r₀, 9r₀, … around a direction show how far the values have moved from
//! those of the smallest ring. While the rings are small against everything that happens there,
//! the change grows at least in proportion to the radius; where it grows no more, the ring is as
//! large as a peak (or a hole) in the middle.

use std::f64::consts::TAU;

use glam::DVec3;
use scattering::{Mueller, lanes::WIDTH};

use super::integrand::{Integrand, NodeDirections};

/// A direction around which the integrand changes within an angle `width`, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Peak {
    pub(super) at: DVec3,
    pub(super) width: f64,
}

/// The smallest ring, rad: angles between directions are not known better than to 1e-8.
const SMALLEST: f64 = 1e-7;

/// Ratio of the radii of two rings.
const RATIO: f64 = 3.0;

/// The number of rings; the largest has a radius of 0.48 rad.
const RINGS: usize = 15;

/// Directions on a ring.
const AROUND: usize = 3;

/// Evaluations around a place.
const PROBES: usize = RINGS * AROUND;

/// The same, in whole groups of lanes.
const ROOM: usize = PROBES.next_multiple_of(WIDTH);

/// Changes of less than this part of the largest value are rounding.
const ROUNDING: f64 = 1e-8;

/// A change that grows by less than this from a ring to the next has ended: √RATIO.
const GROWTH: f64 = 1.7;

/// The width of what is as smooth as the largest ring is wide.
pub(super) const SMOOTH: f64 = 1.0;

/// The peaks of `integrand`, the narrowest first, and the number of evaluations.
///
/// The first one stands for the pole of coordinates and may be smooth; the others are peaks.
pub(super) fn find(integrand: &Integrand<'_>) -> (Vec<Peak>, u64) {
    let places = integrand.gathering();
    let evaluations = (places.len() * ROOM) as u64;
    let mut peaks: Vec<Peak> = places.into_iter().map(|at| measured(integrand, at)).collect();
    // The sort is stable: of equal ones the likeliest stays in front.
    peaks.sort_by(|a, b| a.width.total_cmp(&b.width));
    let first = peaks[0];
    peaks.retain(|peak| *peak == first || peak.width < SMOOTH && peak.at != first.at);
    peaks.dedup();
    (peaks, evaluations)
}

fn measured(integrand: &Integrand<'_>, at: DVec3) -> Peak {
    let q = at.any_orthonormal_vector();
    let p = at.cross(q);
    // An odd angle keeps the rings away from the planes of symmetry.
    let around: [DVec3; AROUND] = std::array::from_fn(|k| {
        let (sin, cos) = (0.4 + TAU * k as f64 / AROUND as f64).sin_cos();
        q * cos + p * sin
    });
    let mut places = NodeDirections::new();
    for k in 0..PROBES {
        let (sin, cos) = (SMALLEST * RATIO.powi((k / AROUND) as i32)).sin_cos();
        let v = at * cos + around[k % AROUND] * sin;
        (places.v[0][k], places.v[1][k], places.v[2][k]) = v.into();
        // The BRDF itself: cos θ changes within its own size next to the horizon.
        places.weights[k] = if v.z > 0.0 { v.z.recip() } else { 1.0 };
    }
    let mut values = [Mueller::ZERO; ROOM];
    integrand.values(&places, &mut values);
    // Directions below the horizon tell nothing.
    let value = |k: usize| if places.v[2][k] > 0.0 { values[k][(0, 0)] } else { f64::NAN };
    let rings = std::array::from_fn(|ring| std::array::from_fn(|k| value(AROUND * ring + k)));
    Peak { at, width: width(&rings) }
}

/// Twice the radius at which half of the change is behind; between two rings it is interpolated.
fn width(rings: &[[f64; AROUND]; RINGS]) -> f64 {
    let values = || rings.iter().flatten().map(|x| x.abs()).filter(|x| x.is_finite());
    let rounding = ROUNDING * values().fold(0.0, f64::max);
    let middle: Vec<f64> = rings[0].iter().copied().filter(|x| x.is_finite()).collect();
    let middle = middle.iter().sum::<f64>() / middle.len() as f64;
    // NaN does not count: max takes the other one.
    let change = |ring: &[f64; AROUND]| ring.iter().map(|x| (x - middle).abs()).fold(0.0, f64::max);
    let changes = rings.each_ref().map(change);
    let has_ended = |k: &usize| changes[k - 1] > rounding && changes[*k] < GROWTH * changes[k - 1];
    let Some(end) = (1..RINGS).find(has_ended) else { return SMOOTH };
    let half = 0.5 * changes[end - 1].max(changes[end]);
    let behind = (0..end).find(|k| changes[*k] >= half).unwrap_or(end);
    let before = behind.saturating_sub(1);
    let part = (half / changes[before]).ln() / (changes[behind] / changes[before]).ln();
    // On the first ring already, or between rings of equal changes.
    let part = if part.is_finite() { part.clamp(0.0, 1.0) } else { 1.0 };
    (2.0 * SMALLEST * RATIO.powf(before as f64 + part)).min(SMOOTH)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rings(f: impl Fn(f64) -> f64) -> [[f64; AROUND]; RINGS] {
        std::array::from_fn(|k| [f(SMALLEST * RATIO.powi(k as i32)); AROUND])
    }

    #[test]
    fn peaks_of_all_shapes_show_their_widths() {
        for w in [1e-6, 1e-4, 3e-3, 0.02] {
            // A thousandth of the background is seen as well.
            for height in [1e3, 1e-3] {
                let gaussian = width(&rings(|r| 1.0 + height * (-r * r / (w * w)).exp()));
                let cusp = width(&rings(|r| 1.0 + height * (-r / w).exp()));
                let tails = width(&rings(|r| 1.0 + height / (1.0 + r * r / (w * w)).powf(1.5)));
                for got in [gaussian, cusp, tails] {
                    assert!(got > 0.3 * w && got < 6.0 * w, "{got} is not about {w}");
                }
            }
        }
    }

    #[test]
    fn what_is_smooth_has_no_peak() {
        let all: [fn(f64) -> f64; 4] = [|_| 2.0, |r| 1.0 - 0.5 * r * r, |r| r.cos() + r, |_| 0.0];
        for f in all {
            assert_eq!(width(&rings(f)), SMOOTH);
        }
    }
}
