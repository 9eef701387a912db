//! Cells of the plane that lie as a whole inside or outside of a polygon: most points are decided
//! by a look at theirs.

use glam::DVec2;

use super::{
    Edge,
    slabs::{MARGIN, turns},
};

/// Cells in rows and columns over the polygon, and one more on each side.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    low: DVec2,
    /// Cells per x and per y.
    per: DVec2,
    side: usize,
    /// Column after column.
    cells: Vec<Cell>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Cell {
    Inside,
    Outside,
    /// An edge runs here, or NIST's rules count a vertex above in an odd way.
    Edges,
}

impl Cells {
    /// `side` cells in x and in y over the polygon with these edges, where `contain` tells which
    /// points are inside; nothing for a polygon that is too small or not finite.
    pub(super) fn new(
        edges: &[Edge],
        side: usize,
        contain: impl Fn(DVec2) -> bool,
    ) -> Option<Self> {
        let vertices = || edges.iter().map(|edge| edge.a);
        let low = vertices().fold(DVec2::INFINITY, DVec2::min);
        let high = vertices().fold(DVec2::NEG_INFINITY, DVec2::max);
        let cell = (high - low) / side as f64;
        let is_fine = vertices().all(DVec2::is_finite) && cell.min_element() > SMALLEST;
        is_fine.then(|| {
            let side = side + 2;
            let cells = vec![Cell::Outside; side * side];
            let mut cells = Self { low: low - cell, per: cell.recip(), side, cells };
            cells.mark(edges);
            cells.fill(contain);
            cells
        })
    }

    /// Marks the cells in which the edges decide.
    fn mark(&mut self, edges: &[Edge]) {
        for edge in edges {
            let (left, right) = (edge.a.x.min(edge.b.x), edge.a.x.max(edge.b.x));
            for column in self.columns(left, right) {
                let at = |k: usize| self.low.x + k as f64 / self.per.x;
                let band = edge.band(at(column) - MARGIN, at(column + 1) + MARGIN);
                if let Some(band) = band {
                    self.mark_column(column, self.row(band.from)..=self.row(band.to));
                }
            }
        }
        for turn in turns(edges) {
            for column in self.columns(turn.x, turn.x) {
                self.mark_column(column, 0..=self.row(turn.y + MARGIN));
            }
        }
    }

    fn mark_column(&mut self, column: usize, rows: std::ops::RangeInclusive<usize>) {
        let first = column * self.side;
        self.cells[first + rows.start()..=first + rows.end()].fill(Cell::Edges);
    }

    /// Finds out about the cells that are not marked; neighbours of a column are alike.
    fn fill(&mut self, contain: impl Fn(DVec2) -> bool) {
        for (column, cells) in self.cells.chunks_exact_mut(self.side).enumerate() {
            let mut above = Cell::Edges;
            for (row, cell) in cells.iter_mut().enumerate().rev() {
                if *cell != Cell::Edges {
                    if above == Cell::Edges {
                        let middle = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
                        let is_inside = contain(self.low + middle / self.per);
                        above = if is_inside { Cell::Inside } else { Cell::Outside };
                    }
                    *cell = above;
                } else {
                    above = Cell::Edges;
                }
            }
        }
    }

    /// The columns of abscissas next to `left` and `right` and of all between.
    fn columns(&self, left: f64, right: f64) -> std::ops::RangeInclusive<usize> {
        let column = |x: f64| (((x - self.low.x) * self.per.x) as usize).min(self.side - 1);
        column(left - MARGIN)..=column(right + MARGIN)
    }

    fn row(&self, y: f64) -> usize {
        (((y - self.low.y) * self.per.y) as usize).min(self.side - 1)
    }

    /// Whether `p` is inside, if its cell tells.
    #[inline]
    pub(super) fn know(&self, p: DVec2) -> Option<bool> {
        let at = (p - self.low) * self.per;
        let side = self.side as f64;
        if !(at.x >= 0.0 && at.y >= 0.0 && at.x < side && at.y < side) {
            return None;
        }
        match self.cells[at.x as usize * self.side + at.y as usize] {
            Cell::Inside => Some(true),
            Cell::Outside => Some(false),
            Cell::Edges => None,
        }
    }
}

/// Cells are not smaller than this: the margins of edges are to be small parts of them.
const SMALLEST: f64 = 100.0 * MARGIN;
