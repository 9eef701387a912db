//! Edges of polygons, and the rules by which they decide about points.

use glam::DVec2;

/// One edge, from `a` to `b`.
#[derive(Clone, Copy, Debug)]
pub(super) struct PolygonEdge {
    pub(super) a: DVec2,
    pub(super) b: DVec2,
}

impl PolygonEdge {
    /// True if a ray from `p` counts this edge: the first rule that applies decides.
    pub(super) fn counts(&self, p: DVec2) -> bool {
        let Self { a, b } = self;
        if (a.x < p.x && b.x <= p.x) || (a.x > p.x && b.x >= p.x) || (a.y < p.y && b.y <= p.y) {
            return false;
        }
        if a.y >= p.y && b.y > p.y {
            return (a.x >= p.x && b.x < p.x) || (a.x <= p.x && b.x > p.x);
        }
        a.y + (b.y - a.y) * (p.x - a.x) / (b.x - a.x) > p.y
    }

    /// True if the open segments cross in one point.
    pub(super) fn crosses(&self, other: &Self) -> bool {
        let (d, e, ac) = (self.b - self.a, other.b - other.a, other.a - self.a);
        let parallel = d.perp_dot(e);
        let (t, u) = (ac.perp_dot(e) / parallel, ac.perp_dot(d) / parallel);
        parallel != 0.0 && 0.0 < t && t < 1.0 && 0.0 < u && u < 1.0
    }
}

/// The edge from vertex `k` to the next one, or to the first.
#[inline]
pub(super) fn edge(vertices: &[DVec2], k: usize) -> PolygonEdge {
    let next = if k + 1 == vertices.len() { 0 } else { k + 1 };
    PolygonEdge { a: vertices[k], b: vertices[next] }
}

/// The edges in order, the closing one last.
pub(super) fn edges(vertices: &[DVec2]) -> impl Iterator<Item = PolygonEdge> + Clone + '_ {
    (0..vertices.len()).map(|k| edge(vertices, k))
}
