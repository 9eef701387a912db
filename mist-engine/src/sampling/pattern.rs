//! The points of the plane: a square grid or random ones, numbered so that any part of them can
//! be visited without the others.

use std::f64::consts::PI;
use std::ops::Range;

use glam::DVec2;

use super::{Sampling, truncated};

/// Where the points of a disk lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Pattern {
    /// One point, the centre.
    One,
    /// x = i `step`, y = j `step` for i and j from −`most` to `most`, j fastest.
    Grid { step: f64, most: i64, radius: f64 },
    /// `count` points, each drawn by its own number.
    Random { count: u64, seed: u64, radius: f64 },
}

impl Pattern {
    /// The pattern of a mode: a grid for 1–3, random points for 4–6.
    pub(super) fn new(sampling: &Sampling, step: f64, radius: f64) -> Self {
        if sampling.mode % 10 > 3 {
            let count = truncated(PI * radius * radius / (step * step));
            let count = u64::try_from(count).unwrap_or(0);
            return Self::Random { count, seed: sampling.seed, radius };
        }
        let most = i64::from(truncated(2.0 * radius / step + 0.5) / 2);
        Self::Grid { step, most, radius }
    }

    /// The number of points, with those outside of the disk.
    pub(super) fn points(&self) -> u64 {
        match *self {
            Self::One => 1,
            Self::Grid { most, .. } if most < 0 => 0,
            Self::Grid { most, .. } => (2 * most.cast_unsigned() + 1).pow(2),
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

    /// Visits the points of the disk with numbers in `range`, in order.
    pub(super) fn for_each(&self, range: Range<u64>, mut visit: impl FnMut(&Run)) {
        match *self {
            Self::One => visit(&Run::of(0.0, 0.0)),
            Self::Grid { step, most, radius } => {
                let (side, end) = (2 * most + 1, range.end.cast_signed());
                let mut next = range.start.cast_signed();
                while next < end {
                    let (i, first) = (next / side - most, next % side - most);
                    let last = most.min(first + (end - next) - 1);
                    next += last - first + 1;
                    let x = i as f64 * step;
                    let mut run = Run::at(x);
                    for y in (first..=last).map(|j| j as f64 * step) {
                        if x * x + y * y <= radius * radius {
                            run.push(y);
                            if run.count == LONGEST {
                                visit(&run);
                                run.count = 0;
                            }
                        }
                    }
                    if run.count > 0 {
                        visit(&run);
                    }
                }
            }
            Self::Random { seed, radius, .. } => {
                for number in range {
                    let (x, y) = in_disk(seed, number, radius);
                    visit(&Run::of(x, y));
                }
            }
        }
    }
}

/// Neighbours of one column of a grid, about which much can be said at once; or a random point.
pub(super) struct Run {
    pub(super) x: f64,
    ys: [f64; LONGEST],
    count: usize,
}

/// Points of a run, at most.
const LONGEST: usize = 8;

impl Run {
    /// No point yet of the column at x.
    fn at(x: f64) -> Self {
        Self { x, ys: [0.0; LONGEST], count: 0 }
    }

    /// One point.
    fn of(x: f64, y: f64) -> Self {
        let mut run = Self::at(x);
        run.push(y);
        run
    }

    fn push(&mut self, y: f64) {
        self.ys[self.count] = y;
        self.count += 1;
    }

    /// The y of the points.
    pub(super) fn ys(&self) -> &[f64] {
        &self.ys[..self.count]
    }

    /// The middle of the points and the distance to the farthest of them; nothing for so few that
    /// it is not worth a look.
    pub(super) fn extent(&self) -> Option<(DVec2, f64)> {
        let [first, _, .., last] = self.ys() else { return None };
        Some((DVec2::new(self.x, 0.5 * (first + last)), 0.5 * (last - first)))
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    fn all(pattern: Pattern, chunk: u64) -> Vec<(f64, f64)> {
        let (mut points, n) = (Vec::new(), pattern.points());
        for start in (0..n).step_by(chunk as usize) {
            pattern.for_each(start..n.min(start + chunk), |run| {
                points.extend(run.ys().iter().map(|y| (run.x, *y)));
            });
        }
        points
    }

    #[test]
    fn chunks_of_any_size_give_the_same_points() {
        let grid = Pattern::Grid { step: 0.1, most: 10, radius: 1.0 };
        let random = Pattern::Random { count: 400, seed: 7, radius: 0.3 };
        for pattern in [grid, random] {
            assert_eq!(all(pattern, 1), all(pattern, 1000));
            assert_eq!(all(pattern, 13), all(pattern, 1000));
        }
    }

    #[test]
    fn grids_run_through_y_first_and_keep_the_rim() {
        let points = all(Pattern::Grid { step: 0.5, most: 2, radius: 1.0 }, 512);
        assert_eq!(points.len(), 13);
        assert_eq!(points[..3], [(-1.0, 0.0), (-0.5, -0.5), (-0.5, 0.0)]);
    }

    #[test]
    fn random_points_fill_the_disk_evenly() {
        // The variance of r² is 1/12: six standard errors of its mean are 0.0123.
        let points = all(Pattern::Random { count: 20_000, seed: 1, radius: 1.0 }, 512);
        let mean = |f: fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / 20_000.0;
        assert!((mean(|(x, y)| x * x + y * y) - 0.5).abs() < 0.0123);
        assert!(mean(|(x, _)| *x).abs() < 0.0213);
        assert!(mean(|(_, y)| *y).abs() < 0.0213);
        assert!(mean(|(x, y)| x * y).abs() < 0.0123);
    }

    #[test]
    fn different_seeds_give_different_points() {
        let of = |seed| all(Pattern::Random { count: 3, seed, radius: 1.0 }, 512);
        assert_eq!(of(3), of(3));
        assert_ne!(of(3), of(4));
    }
}
