//! The edges of a polygon sorted into slabs of x, so that a test looks at the few that can matter.

use glam::DVec2;

use super::edge::{PolygonEdge, edge};

/// An edge whose two ends lie on the same side of a point in x is never counted, so leaving it
/// out changes no decision.
#[derive(Clone, Debug, Default)]
pub(super) struct Slabs {
    low: f64,
    high: f64,
    per_x: f64,
    /// Starts of the edges of each slab in the list, and after the last one their end.
    starts: Vec<u32>,
    /// The numbers of the edges, slab after slab.
    edges: Vec<u32>,
}

impl Slabs {
    /// `count` slabs of the polygon with these vertices; none if it is empty or not finite.
    pub(super) fn new(vertices: &[DVec2], count: usize) -> Self {
        if vertices.iter().any(|v| !v.is_finite()) || vertices.is_empty() {
            return Self::default();
        }
        let xs = || vertices.iter().map(|v| v.x);
        let (low, high) =
            (xs().fold(f64::INFINITY, f64::min), xs().fold(f64::NEG_INFINITY, f64::max));
        let per_x = if high > low { count as f64 / (high - low) } else { 0.0 };
        let mut slabs = Self { low, high, per_x, starts: vec![0; count + 1], edges: Vec::new() };
        for number in 0..vertices.len() {
            for k in slabs.reached(edge(vertices, number)) {
                slabs.starts[k + 1] += 1;
            }
        }
        for k in 0..count {
            slabs.starts[k + 1] += slabs.starts[k];
        }
        slabs.edges = vec![0; slabs.starts[count] as usize];
        let mut next = slabs.starts.clone();
        for number in 0..vertices.len() {
            for k in slabs.reached(edge(vertices, number)) {
                slabs.edges[next[k] as usize] = number as u32;
                next[k] += 1;
            }
        }
        slabs
    }

    /// The slabs that an edge runs through.
    fn reached(&self, PolygonEdge { a, b }: PolygonEdge) -> std::ops::RangeInclusive<usize> {
        self.index(a.x.min(b.x))..=self.index(a.x.max(b.x))
    }

    /// The slab of `x`; a monotone function of it.
    #[inline]
    fn index(&self, x: f64) -> usize {
        (((x - self.low) * self.per_x) as usize).min(self.starts.len() - 2)
    }

    /// True if `p` is inside of the polygon with these vertices.
    #[inline]
    pub(super) fn contain(&self, vertices: &[DVec2], p: DVec2) -> bool {
        if self.starts.is_empty() || !(self.low <= p.x && p.x <= self.high) {
            return false;
        }
        let slab = self.index(p.x);
        let here = self.starts[slab] as usize..self.starts[slab + 1] as usize;
        let counted = self.edges[here].iter().filter(|k| edge(vertices, **k as usize).counts(p));
        counted.count() % 2 == 1
    }
}
