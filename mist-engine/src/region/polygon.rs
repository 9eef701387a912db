//! Polygons in the plane of the sample, and which points NIST's rules put inside of them.

mod cells;
mod edge;
mod slabs;

pub(crate) use cells::{CellContent, PolygonCells};

use edge::{edge, edges};
use glam::DVec2;
use slabs::Slabs;

/// A polygon, closed from its last vertex to its first.
#[derive(Clone, Debug)]
pub(crate) struct Polygon {
    vertices: Vec<DVec2>,
    slabs: Slabs,
    /// Only for polygons about which many points are asked.
    cells: Option<PolygonCells>,
}

/// Smallest and largest number of slabs, and number of edges per slab.
const SLABS: (usize, usize, usize) = (16, 1024, 2);
/// Smallest and largest number of rows of cells, and number of points per cell of each
/// row and column: to fill the cells costs less than they save.
const CELLS: (usize, usize, f64) = (16, 128, 3.0);

impl Polygon {
    /// The polygon with these vertices; few or none of them are fine.
    pub(crate) fn new(vertices: Vec<DVec2>) -> Self {
        let (least, most, edges) = SLABS;
        let slabs = Slabs::new(&vertices, (vertices.len() / edges).clamp(least, most));
        Self { vertices, slabs, cells: None }
    }

    /// The same polygon, made ready for about so many points.
    pub(crate) fn for_points(mut self, count: u64) -> Self {
        let (least, most, points) = CELLS;
        let side = (count as f64 / points).sqrt() as usize;
        if side >= least {
            self.cells = PolygonCells::new(&self.vertices, side.min(most), |p| self.contains(p));
        }
        self
    }

    /// True if `p` is inside by the even–odd rule, with NIST's decisions for points on an edge.
    pub(crate) fn contains(&self, p: DVec2) -> bool {
        self.slabs.contain(&self.vertices, p)
    }

    /// Known position of points that are far from all edges, for any rounding of their
    /// coordinates.
    pub(crate) fn cells(&self) -> Option<&PolygonCells> {
        self.cells.as_ref()
    }

    /// The absolute value of the shoelace sum.
    pub(crate) fn area(&self) -> f64 {
        (0.5 * edges(&self.vertices).map(|e| e.a.perp_dot(e.b)).sum::<f64>()).abs()
    }

    /// Two edges that cross, by the vertices they run to, counted from 0.
    ///
    /// The edge to the last vertex and the closing edge are tested only if `all`; NIST's
    /// program does not test them as the later of the two.
    pub(crate) fn crossing(&self, all: bool) -> Option<(usize, usize)> {
        let n = self.vertices.len();
        let edge = |k: usize| edge(&self.vertices, (k + n - 1) % n);
        if all {
            let mut pairs = (0..n).flat_map(|j| (j + 2..n).map(move |i| (j, i)));
            return pairs.find(|(j, i)| edge(*j).crosses(&edge(*i)));
        }
        let mut pairs = (1..n).flat_map(|j| (j + 2..n.saturating_sub(1)).map(move |i| (j, i)));
        pairs.find(|(j, i)| edge(*j).crosses(&edge(*i)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn star() -> Vec<DVec2> {
        let radius = |k: usize| if k.is_multiple_of(2) { 0.9 } else { 0.3 };
        (0..14).map(|k| DVec2::from_angle(0.2 + 0.45 * k as f64) * radius(k)).collect()
    }

    #[test]
    fn slabs_change_no_decision() {
        let vertices = star();
        let polygon = Polygon::new(vertices.clone());
        let plain = |p| edges(&vertices).filter(|e| e.counts(p)).count() % 2 == 1;
        for i in -50..=50 {
            for j in -50..=50 {
                let p = DVec2::new(f64::from(i), f64::from(j)) * 0.02;
                assert_eq!(polygon.contains(p), plain(p), "{p}");
            }
        }
        for p in vertices.iter().chain(&[DVec2::new(0.9, 0.0)]) {
            assert_eq!(polygon.contains(*p), plain(*p), "{p}");
        }
    }

    /// Two rings joined by a bridge, a small one, and one with edges along the axes.
    fn odd_ones() -> [Vec<DVec2>; 3] {
        let ring = |radius: f64, count: usize| {
            let step = std::f64::consts::TAU / count as f64;
            (0..=count).map(move |k| DVec2::from_angle(step * k as f64) * radius)
        };
        let joined: Vec<DVec2> = ring(0.3, 90).chain(ring(0.7, 90)).collect();
        let small: Vec<DVec2> = ring(1e-8, 40).collect();
        let stairs = [(0.0, 0.0), (0.6, 0.0), (0.6, 0.2), (0.3, 0.2), (0.3, 0.5), (0.0, 0.5)];
        [joined, small, stairs.map(|(x, y)| DVec2::new(x, y)).to_vec()]
    }

    #[test]
    fn what_the_cells_know_is_what_the_edges_say() {
        for vertices in odd_ones().into_iter().chain([star()]) {
            let polygon = Polygon::new(vertices.clone()).for_points(20_000);
            let plain = |p| edges(&vertices).filter(|e| e.counts(p)).count() % 2 == 1;
            let reach = vertices.iter().map(|v| v.length()).fold(0.0, f64::max);
            let grid = |k: i32| f64::from(k) * 0.0171 * reach;
            let (mut known, mut all) = (0, 0);
            let know = |p: DVec2| {
                let cells = polygon.cells()?;
                let cell = cells.all()[cells.number(p.to_array()) as usize];
                (cell != CellContent::Edges).then_some(cell == CellContent::Inside)
            };
            // Points in line with vertices are the ones that the rules may decide otherwise.
            let xs = (-70..=70).map(grid).chain(vertices.iter().map(|v| v.x));
            for x in xs {
                for y in (-70..=70).map(grid).chain(vertices.iter().map(|v| v.y)) {
                    let p = DVec2::new(x, y);
                    all += 1;
                    let Some(state) = know(p) else { continue };
                    known += 1;
                    assert_eq!(plain(p), state, "{p}");
                }
            }
            // A polygon of the size of a rounding error has no cells.
            assert_eq!(known > all / 2, reach > 1e-3, "{known} of {all}");
        }
    }

    #[test]
    fn points_in_line_with_the_vertices_of_rings_are_decided_by_their_edges() {
        for vertices in odd_ones() {
            let polygon = Polygon::new(vertices.clone());
            let plain = |p| edges(&vertices).filter(|e| e.counts(p)).count() % 2 == 1;
            let reach = vertices.iter().map(|v| v.length()).fold(0.0, f64::max);
            for x in vertices.iter().flat_map(|v| [v.x, v.x + 1e-3 * reach]) {
                let ys = (-60..=60).map(|k| 0.02 * reach * f64::from(k));
                for y in ys.chain(vertices.iter().map(|v| v.y)) {
                    let p = DVec2::new(x, y);
                    assert_eq!(polygon.contains(p), plain(p), "{p}");
                }
            }
        }
    }

    #[test]
    fn points_on_the_edges_of_a_square_belong_to_its_right_and_lower_sides() {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let square = Polygon::new(corners.map(|(x, y)| DVec2::new(x, y)).to_vec());
        let inside = |x, y| square.contains(DVec2::new(x, y));
        assert!(inside(0.5, 0.5) && !inside(1.5, 0.5) && !inside(0.5, -0.5));
        assert!(!inside(0.5, 1.0), "on the upper edge");
        assert!((square.area() - 1.0).abs() < 1e-16);
    }

    #[test]
    fn a_bow_tie_of_four_vertices_passes_the_short_test_only() {
        let corners = [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)];
        let bow = Polygon::new(corners.map(|(x, y)| DVec2::new(x, y)).to_vec());
        assert_eq!(bow.crossing(false), None);
        assert_eq!(bow.crossing(true), Some((1, 3)));
    }

    #[test]
    fn repeated_vertices_and_empty_polygons_are_harmless() {
        let empty = Polygon::new(Vec::new());
        assert!(!empty.contains(DVec2::ZERO));
        assert_eq!((empty.area(), empty.crossing(true)), (0.0, None));
        let point = Polygon::new(vec![DVec2::ZERO; 3]);
        assert!(!point.contains(DVec2::ZERO));
        assert_eq!(point.crossing(true), None);
        assert!(!Polygon::new(vec![DVec2::NAN; 3]).contains(DVec2::ZERO));
    }
}
