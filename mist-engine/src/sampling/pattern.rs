//! The points of the plane: a square grid or random ones, numbered so that any part of them can
//! be visited without the others.

use std::f64::consts::PI;
use std::ops::Range;

use super::points::PlanePoints;

/// Arrangement of the points of a disk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PointPattern {
    /// One point, the centre.
    One,
    /// x = i `step`, y = j `step` for i and j from −`most` to `most`, j fastest.
    Grid { step: f64, most: i32, radius: f64 },
    /// `count` points, each drawn by its own number.
    Random { count: u64, seed: u64, radius: f64 },
}

impl PointPattern {
    /// A grid of this step in a disk, or as many random points as it has if there is a `seed`.
    pub(super) fn new(step: f64, radius: f64, seed: Option<u64>) -> Self {
        if let Some(seed) = seed {
            let count = truncated(PI * radius * radius / (step * step));
            let count = u64::try_from(count).unwrap_or(0);
            return Self::Random { count, seed, radius };
        }
        let most = truncated(2.0 * radius / step + 0.5) / 2;
        Self::Grid { step, most, radius }
    }

    /// The number of points, with those outside of the disk.
    pub(super) fn points(&self) -> u64 {
        match *self {
            Self::One => 1,
            Self::Grid { most, .. } if most < 0 => 0,
            Self::Grid { most, .. } => (2 * u64::from(most.cast_unsigned()) + 1).pow(2),
            Self::Random { count, .. } => count,
        }
    }

    /// The area of the plane that one point stands for.
    pub(super) fn area_per_point(&self) -> f64 {
        match *self {
            Self::One => 1.0,
            Self::Grid { step, .. } => step * step,
            Self::Random { count, radius, .. } => PI * radius * radius / count as f64,
        }
    }

    /// Puts the points of the disk with numbers in `range` into `points`, in order.
    pub(super) fn part(&self, range: Range<u64>, points: &mut PlanePoints) {
        points.clear();
        match *self {
            Self::One => points.push(0.0, [0.0]),
            Self::Grid { step, most, radius } => {
                let (side, end) = (2 * i64::from(most) + 1, range.end.cast_signed());
                let mut next = range.start.cast_signed();
                while next < end {
                    // Of 32 bits, from which vectors of numbers are made at once.
                    let (i, first) = ((next / side) as i32 - most, (next % side) as i32 - most);
                    let last = i64::from(most).min(i64::from(first) + (end - next) - 1) as i32;
                    next += i64::from(last - first) + 1;
                    let x = f64::from(i) * step;
                    let reach = reach(x, step, most, radius);
                    let (first, last) = (first.max(-reach), last.min(reach));
                    points.push(x, (first..last + 1).map(|j| f64::from(j) * step));
                }
            }
            Self::Random { seed, radius, .. } => {
                for number in range {
                    let (x, y) = in_disk(seed, number, radius);
                    points.push(x, [y]);
                }
            }
        }
    }
}

/// The largest j ≤ `most` for which (x, j `step`) lies in the disk, rim included; −1 if none does.
fn reach(x: f64, step: f64, most: i32, radius: f64) -> i32 {
    let is_in_disk = |j: i32| {
        let y = f64::from(j) * step;
        x * x + y * y <= radius * radius
    };
    // The root may be off by its rounding.
    let mut reach = (((radius * radius - x * x).max(0.0).sqrt() / step) as i32).clamp(0, most);
    while reach >= 0 && !is_in_disk(reach) {
        reach -= 1;
    }
    while reach < most && is_in_disk(reach + 1) {
        reach += 1;
    }
    reach
}

/// The random point with this number, uniform in the open disk.
///
/// Its coordinates are those of the first of its own random pairs in the square around the disk
/// that lies in the disk.
fn in_disk(seed: u64, number: u64, radius: f64) -> (f64, f64) {
    let mut state = mixed(seed ^ mixed(number));
    loop {
        let mut coordinate = || {
            state = state.wrapping_add(GOLDEN);
            (2.0 * uniform(mixed(state)) - 1.0) * radius
        };
        let (x, y) = (coordinate(), coordinate());
        if x * x + y * y < radius * radius || radius.is_nan() || radius == 0.0 {
            return (x, y);
        }
    }
}

/// 2⁶⁴ over the golden ratio, odd: the stride of SplitMix64.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// The finalizer of SplitMix64: a bijection in which every input bit affects every output bit
/// (G. L. Steele, D. Lea, C. H. Flood, *Fast splittable pseudorandom number generators*,
/// OOPSLA 2014).
fn mixed(x: u64) -> u64 {
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// A number in 0 ≤ u < 1 from the upper 53 bits.
fn uniform(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

/// The whole part of `x` as C's (int) gives it on x86: i32::MIN where it does not fit.
pub(crate) fn truncated(x: f64) -> i32 {
    let whole = x.trunc();
    if whole >= f64::from(i32::MIN) && whole <= f64::from(i32::MAX) {
        whole as i32
    } else {
        i32::MIN
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(pattern: PointPattern, chunk: u64) -> Vec<(f64, f64)> {
        let n = pattern.points();
        let part = |start| {
            let mut points = PlanePoints::default();
            pattern.part(start..n.min(start + chunk), &mut points);
            points.all().collect::<Vec<_>>()
        };
        (0..n).step_by(chunk as usize).flat_map(part).collect()
    }

    #[test]
    fn chunks_of_any_size_give_the_same_points() {
        let grid = PointPattern::Grid { step: 0.1, most: 10, radius: 1.0 };
        let random = PointPattern::Random { count: 400, seed: 7, radius: 0.3 };
        for pattern in [grid, random] {
            assert_eq!(all(pattern, 1), all(pattern, 1000));
            assert_eq!(all(pattern, 13), all(pattern, 1000));
        }
    }

    #[test]
    fn grids_run_through_y_first_and_keep_the_rim() {
        let points = all(PointPattern::Grid { step: 0.5, most: 2, radius: 1.0 }, 512);
        assert_eq!(points.len(), 13);
        assert_eq!(points[..3], [(-1.0, 0.0), (-0.5, -0.5), (-0.5, 0.0)]);
    }

    #[test]
    fn columns_end_where_the_disk_ends_whatever_the_rounding() {
        for k in 0..400 {
            let (step, radius) = (0.01 + 1e-3 * f64::from(k % 7), 0.05 * f64::from(k));
            let most = (2.0 * radius / step + 0.5) as i32 / 2;
            for i in -most..=most {
                let x = f64::from(i) * step;
                let is_in_disk = |j: &i32| {
                    let y = f64::from(*j) * step;
                    x * x + y * y <= radius * radius
                };
                let want = (0..=most).take_while(is_in_disk).count() as i32 - 1;
                assert_eq!(reach(x, step, most, radius), want, "{x} {step} {radius}");
            }
        }
        assert_eq!(reach(0.0, 0.1, 10, f64::NAN), -1);
    }

    #[test]
    fn random_points_fill_the_disk_evenly() {
        // The variance of r² is 1/12: six standard errors of its mean are 0.0123.
        let points = all(PointPattern::Random { count: 20_000, seed: 1, radius: 1.0 }, 512);
        let mean = |f: fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / 20_000.0;
        assert!((mean(|(x, y)| x * x + y * y) - 0.5).abs() < 0.0123);
        assert!(mean(|(x, _)| *x).abs() < 0.0213);
        assert!(mean(|(_, y)| *y).abs() < 0.0213);
        assert!(mean(|(x, y)| x * y).abs() < 0.0123);
    }

    #[test]
    fn different_seeds_give_different_points() {
        let of = |seed| all(PointPattern::Random { count: 3, seed, radius: 1.0 }, 512);
        assert_eq!(of(3), of(3));
        assert_ne!(of(3), of(4));
    }
}
