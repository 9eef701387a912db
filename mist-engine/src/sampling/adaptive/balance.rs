//! Cells that are much longer than those which they touch.
//!
//! A ridge of the integrand that is finer than the nodes of a cell is lost without a trace: all
//! nodes may lie beside it. But a ridge goes on from cell to cell, and where it has been seen, the
//! cells have become fine.

use super::cell::{CubatureCell, MeasuredCell};

/// Largest ratio of the length of a cell to that of its neighbour: its eight nodes are not further
/// apart than the shorter one is long.
const RATIO: f64 = 8.0;

/// One side of a cell, as it meets others.
struct CellSide {
    /// The slice, the interval, and where across the cells touch.
    line: (usize, usize, f64),
    /// From where to where along the line.
    reach: (f64, f64),
    /// True if the cell begins here or ends.
    begins: bool,
    cell: usize,
}

/// The cells that are too long for a neighbour, and whether along p; in order.
pub(super) fn too_long(cells: &[MeasuredCell]) -> Vec<(usize, bool)> {
    let mut found = Vec::new();
    for along_p in [true, false] {
        let lengths = cells.iter().map(|c| length(reach(&c.cell, along_p)));
        let shortest = lengths.clone().fold(f64::INFINITY, f64::min);
        if lengths.fold(0.0, f64::max) > RATIO * shortest {
            found.extend(beside_shorter(cells, along_p).into_iter().map(|k| (k, along_p)));
        }
    }
    // A cell is halved one way at a time.
    found.sort_unstable();
    found.dedup_by_key(|(k, _)| *k);
    found
}

fn beside_shorter(cells: &[MeasuredCell], along_p: bool) -> Vec<usize> {
    let mut sides: Vec<CellSide> = Vec::with_capacity(2 * cells.len());
    for (k, MeasuredCell { cell, .. }) in cells.iter().enumerate() {
        let (from, to) = reach(cell, !along_p);
        for (at, begins) in [(from, true), (to, false)] {
            let line = (cell.slice, cell.interval, at);
            sides.push(CellSide { line, reach: reach(cell, along_p), begins, cell: k });
        }
    }
    let key = |side: &CellSide| (side.line, side.reach.0);
    sides.sort_by(|a, b| key(a).partial_cmp(&key(b)).expect("numbers"));
    let mut found = Vec::new();
    for line in sides.chunk_by(|a, b| a.line == b.line) {
        // The last side that began on either hand: what overlaps a later one.
        let mut last: [Option<&CellSide>; 2] = [None; 2];
        for side in line {
            if let Some(other) = last[usize::from(!side.begins)]
                && other.reach.1 > side.reach.0
            {
                let (mine, others) = (length(side.reach), length(other.reach));
                if mine > RATIO * others {
                    found.push(side.cell);
                } else if others > RATIO * mine {
                    found.push(other.cell);
                }
            }
            last[usize::from(side.begins)] = Some(side);
        }
    }
    found
}

fn reach(cell: &CubatureCell, along_p: bool) -> (f64, f64) {
    if along_p { cell.s } else { cell.u }
}

fn length((from, to): (f64, f64)) -> f64 {
    to - from
}

#[cfg(test)]
mod tests {
    use scattering::Mueller;

    use super::*;

    fn measured(cells: &[CubatureCell]) -> Vec<MeasuredCell> {
        let zero = Mueller::ZERO;
        cells
            .iter()
            .map(|cell| MeasuredCell { cell: *cell, matrix: zero, error: zero, along_p: false })
            .collect()
    }

    fn cell(interval: usize, s: (f64, f64), u: (f64, f64)) -> CubatureCell {
        CubatureCell { slice: 3, interval, s, u }
    }

    #[test]
    fn only_what_touches_a_much_shorter_cell_is_too_long() {
        let mut cells = vec![
            cell(0, (0.0, 1.0), (0.0, 0.25)),
            cell(0, (0.0, 0.5), (0.25, 0.5)),
            cell(0, (0.0, 1.0), (0.5, 1.0)),
            cell(1, (0.0, 1.0), (0.0, 1.0)),
        ];
        cells.extend((0..16).map(|k| {
            let s = |k: i32| 0.5 + f64::from(k) / 32.0;
            cell(0, (s(k), s(k + 1)), (0.25, 0.5))
        }));
        assert_eq!(too_long(&measured(&cells)), [(0, true), (2, true)]);
        // The same with the sides exchanged.
        for each in &mut cells {
            (each.s, each.u) = (each.u, each.s);
        }
        assert_eq!(too_long(&measured(&cells)), [(0, false), (2, false)]);
    }

    #[test]
    fn cells_of_about_the_same_size_are_left_alone() {
        let cell = cell(0, (0.0, 1.0), (0.0, 1.0));
        let [left, right] = cell.halves(true);
        let [low, high] = right.halves(false);
        assert_eq!(too_long(&measured(&[left, low, high])), []);
    }
}
