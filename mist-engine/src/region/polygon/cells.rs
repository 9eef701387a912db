//! Cells of the plane that lie as a whole inside or outside of a polygon: most points are decided
//! by a look at theirs.

use std::ops::RangeInclusive;

use glam::DVec2;
use scattering::lanes::Real;

use super::edge::{PolygonEdge, edges};

/// Cells in rows and columns over the polygon, and one and a half more on each side: those of the
/// margin hold no vertex.
#[derive(Clone, Debug)]
pub(crate) struct PolygonCells {
    low: DVec2,
    /// Cells per x and per y.
    per: DVec2,
    side: usize,
    /// Column after column.
    cells: Vec<CellContent>,
}

/// Known position of the points of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CellContent {
    /// They are inside.
    Inside,
    /// They are outside.
    Outside,
    /// An edge runs here, or NIST's rules count a vertex above in an odd way.
    Edges,
}

impl PolygonCells {
    /// `side` cells in x and in y over the polygon with these vertices, where `contain` tells which
    /// points are inside; nothing for a polygon that is too small or not finite.
    pub(super) fn new(
        vertices: &[DVec2],
        side: usize,
        contain: impl Fn(DVec2) -> bool,
    ) -> Option<Self> {
        let corner =
            |start, next: fn(DVec2, DVec2) -> DVec2| vertices.iter().copied().fold(start, next);
        let low = corner(DVec2::INFINITY, DVec2::min);
        let high = corner(DVec2::NEG_INFINITY, DVec2::max);
        let cell = (high - low) / side as f64;
        let is_fine = vertices.iter().all(|v| v.is_finite()) && cell.min_element() > SMALLEST;
        is_fine.then(|| {
            let side = side + 3;
            let cells = vec![CellContent::Outside; side * side];
            let mut cells = Self { low: low - 1.5 * cell, per: cell.recip(), side, cells };
            cells.mark(vertices);
            cells.fill(contain);
            cells.cells[0] = CellContent::Edges;
            cells
        })
    }

    /// Marks the cells in which the edges decide.
    fn mark(&mut self, vertices: &[DVec2]) {
        for edge in edges(vertices) {
            let (left, right) = (edge.a.x.min(edge.b.x), edge.a.x.max(edge.b.x));
            for column in self.columns(left, right) {
                let at = |k: usize| self.low.x + k as f64 / self.per.x;
                let band = edge.band(at(column) - MARGIN, at(column + 1) + MARGIN);
                if let Some((from, to)) = band {
                    self.mark_column(column, self.row(from - MARGIN)..=self.row(to + MARGIN));
                }
            }
        }
        for turn in turns(vertices) {
            for column in self.columns(turn.x, turn.x) {
                self.mark_column(column, 0..=self.row(turn.y + MARGIN));
            }
        }
    }

    fn mark_column(&mut self, column: usize, rows: RangeInclusive<usize>) {
        let first = column * self.side;
        self.cells[first + rows.start()..=first + rows.end()].fill(CellContent::Edges);
    }

    /// Finds out about the cells that are not marked; neighbours of a column are alike.
    fn fill(&mut self, contain: impl Fn(DVec2) -> bool) {
        for (column, cells) in self.cells.chunks_exact_mut(self.side).enumerate() {
            let mut above = CellContent::Edges;
            for (row, cell) in cells.iter_mut().enumerate().rev() {
                if *cell != CellContent::Edges {
                    if above == CellContent::Edges {
                        let middle = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
                        let is_inside = contain(self.low + middle / self.per);
                        above = if is_inside { CellContent::Inside } else { CellContent::Outside };
                    }
                    *cell = above;
                } else {
                    above = CellContent::Edges;
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

    /// All cells by their numbers: the first is one of [`CellContent::Edges`], the last lies outside.
    pub(crate) fn all(&self) -> &[CellContent] {
        &self.cells
    }
}

impl PolygonEdge {
    /// The lowest and the highest y where it runs between the abscissas `left` and `right`, if it
    /// does.
    fn band(&self, left: f64, right: f64) -> Option<(f64, f64)> {
        let Self { a, b } = self;
        let (from, to) = (left.max(a.x.min(b.x)), right.min(a.x.max(b.x)));
        if from > to {
            return None;
        }
        let at = |x: f64| a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x)).clamp(0.0, 1.0);
        let (one, other) = if a.x == b.x { (a.y, b.y) } else { (at(from), at(to)) };
        Some((one.min(other), one.max(other)))
    }
}

/// The vertices whose neighbours lie on the same side of them, or above or below. NIST's rules
/// count a vertex above a point by one of its two edges, which is the wrong number here.
fn turns(vertices: &[DVec2]) -> impl Iterator<Item = DVec2> + '_ {
    let next = edges(vertices).cycle().skip(1);
    edges(vertices).zip(next).filter_map(|(edge, next)| {
        let (before, behind) = (edge.b.x - edge.a.x, next.b.x - next.a.x);
        (!(before * behind > 0.0)).then_some(edge.b)
    })
}

/// Closer to an edge than this the edge itself decides: far more than rounding.
const MARGIN: f64 = 1e-9;

/// Cells are not smaller than this: the margins of edges are to be small parts of them.
const SMALLEST: f64 = 100.0 * MARGIN;
