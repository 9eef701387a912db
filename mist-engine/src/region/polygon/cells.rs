//! Cells of the plane that lie as a whole inside or outside of a polygon: most points are decided
//! by a look at theirs.

use std::ops::RangeInclusive;

use glam::DVec2;
use scattering::lanes::Real;

use super::{
    Edge,
    slabs::{MARGIN, turns},
};

/// Cells in rows and columns over the polygon, and one more on each side.
#[derive(Clone, Debug)]
pub(crate) struct Cells {
    low: DVec2,
    /// Cells per x and per y.
    per: DVec2,
    side: usize,
    /// Column after column.
    cells: Vec<Cell>,
}

/// What is known about the points of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cell {
    /// They are inside.
    Inside,
    /// They are outside.
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
            cells.cells[0] = Cell::Edges;
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

    fn mark_column(&mut self, column: usize, rows: RangeInclusive<usize>) {
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
    fn columns(&self, left: f64, right: f64) -> RangeInclusive<usize> {
        let column = |x: f64| (((x - self.low.x) * self.per.x) as usize).min(self.side - 1);
        column(left - MARGIN)..=column(right + MARGIN)
    }

    fn row(&self, y: f64) -> usize {
        (((y - self.low.y) * self.per.y) as usize).min(self.side - 1)
    }

    /// The number of the cell of the point (x, y), or of several points; those beside all cells
    /// belong to the nearest.
    #[inline(always)]
    pub(crate) fn number<R: Real>(&self, [x, y]: [R; 2]) -> R {
        let last = (self.side - 1) as f64;
        let column = ((x - self.low.x) * self.per.x - 0.5).rounded_within(last);
        let row = ((y - self.low.y) * self.per.y - 0.5).rounded_within(last);
        column * self.side as f64 + row
    }

    /// All cells by their numbers: the first is one of [`Cell::Edges`], the last lies outside.
    pub(crate) fn all(&self) -> &[Cell] {
        &self.cells
    }
}

/// Cells are not smaller than this: the margins of edges are to be small parts of them.
const SMALLEST: f64 = 100.0 * MARGIN;
