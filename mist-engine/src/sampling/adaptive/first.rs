//! The first cells of a region, before anything is known of the integrand but its peaks.

use glam::DVec3;
use smallvec::SmallVec;

use super::{cell::CubatureCell, peaks::Peak, rays::Rays};

/// Longest first cell along a ray, in w, where t = ε sinh w.
const LONGEST: f64 = 2.0;

/// Ends of intervals that move by more than this in w within a first cell divide it.
const FAR: f64 = 1.3;

/// Halvings of a slice before the first cells are made, for the ends of intervals.
const SPLITS: usize = 6;

/// Halvings of a slice towards a ray that touches a circle.
const MOST_SPLITS: usize = 12;

/// Distance from the ends of cells at which they are measured, in halves of a cell.
const INSET: f64 = 1e-6;

/// Cells towards a peak, at most: 14 halvings both ways need a few hundred.
const MOST_FIRST: usize = 20_000;

impl Rays {
    /// The first cells: all intervals of all slices, cut into pieces along the rays and towards
    /// `peaks`.
    pub(super) fn first_cells(&self, peaks: &[Peak]) -> Vec<CubatureCell> {
        let cells = self.even_cells();
        peaks.iter().fold(cells, |cells, peak| self.towards(peak, cells))
    }

    fn even_cells(&self) -> Vec<CubatureCell> {
        let mut cells = Vec::new();
        for slice in 0..self.slices.len() {
            self.split(slice, (0.0, 1.0), 0, &mut cells);
        }
        cells
    }

    /// The cells of a part of a slice: of parts of it in which the ends of intervals move by no
    /// more than FAR, for where an edge passes close to the pole, they run away within a small
    /// angle, and which hide nothing.
    fn split(&self, slice: usize, s: (f64, f64), depth: usize, cells: &mut Vec<CubatureCell>) {
        let middle = 0.5 * (s.0 + s.1);
        // The ends themselves may touch an edge.
        let [first, last] =
            [s.0, s.1].map(|end| self.stretches(slice, end + 1e-3 * (middle - end)));
        let moved = |(a, b): (&(f64, f64), &(f64, f64))| (a.0 - b.0).abs().max((a.1 - b.1).abs());
        let most = first.iter().zip(&last).map(moved).fold(0.0, f64::max);
        let is_split =
            most >= FAR && depth < SPLITS || self.slices[slice].hides(s) && depth < MOST_SPLITS;
        if is_split {
            self.split(slice, (s.0, middle), depth + 1, cells);
            self.split(slice, (middle, s.1), depth + 1, cells);
            return;
        }
        let at = [first, self.stretches(slice, middle), last];
        let count = at.iter().map(SmallVec::len).max().unwrap_or(0);
        for interval in 0..count {
            let lengths = at.iter().filter_map(|all| all.get(interval)).map(|w| w.1 - w.0);
            let pieces = (lengths.fold(0.0, f64::max) / LONGEST).ceil().max(1.0);
            let begins_at_pole = at[1].get(interval).is_some_and(|w| w.0 == 0.0);
            for k in 0..pieces as usize {
                let u = (k as f64 / pieces, (k + 1) as f64 / pieces);
                let cell = CubatureCell { slice, interval, s, u };
                // Most of a peak is in the first of several pieces.
                if k == 0 && pieces > 1.0 && begins_at_pole {
                    cells.extend(cell.halves(false));
                } else {
                    cells.push(cell);
                }
            }
        }
    }

    /// The cells with those near to `peak` halved until they are not wider than the peak, and
    /// else than their distance from it.
    fn towards(&self, peak: &Peak, mut cells: Vec<CubatureCell>) -> Vec<CubatureCell> {
        let mut done = Vec::new();
        while let Some(cell) = cells.pop() {
            let (middle, along_p, along_t) = self.extent(&cell);
            let size = along_p.max(along_t);
            let is_near = middle.distance(peak.at) < along_p + along_t;
            if is_near && size > peak.width && done.len() + cells.len() < MOST_FIRST {
                cells.extend(cell.halves(along_p > along_t));
            } else {
                done.push(cell);
            }
        }
        done
    }

    /// The middle of a cell and how far it reaches along p and along t.
    fn extent(&self, cell: &CubatureCell) -> (DVec3, f64, f64) {
        let at = |s: f64, u: f64| DVec3::from(self.ray(cell.slice, cell.interval, s).at(u).0);
        let (s, u) = (0.5 * (cell.s.0 + cell.s.1), 0.5 * (cell.u.0 + cell.u.1));
        // On the ends themselves an interval may have no length.
        let [first, last] = [cell.s.0, cell.s.1].map(|end| end + INSET * (s - end));
        let along_p = at(first, u).distance(at(last, u));
        (at(s, u), along_p, at(s, cell.u.0).distance(at(s, cell.u.1)))
    }
}
