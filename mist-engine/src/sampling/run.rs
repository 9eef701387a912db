//! Neighbouring points of a grid, about which much can be said at once.

use glam::DVec2;

/// Points that are looked at together, at most.
const MOST: usize = 8;

/// Points of one column of the grid, in order.
#[derive(Default)]
pub(super) struct Run {
    points: [DVec2; MOST],
    count: usize,
}

impl Run {
    /// Whether `p` can be the next point.
    pub(super) fn takes(&self, p: DVec2) -> bool {
        self.count == 0 || (self.count < MOST && self.points[0].x == p.x)
    }

    pub(super) fn push(&mut self, p: DVec2) {
        self.points[self.count] = p;
        self.count += 1;
    }

    pub(super) fn clear(&mut self) {
        self.count = 0;
    }

    pub(super) fn points(&self) -> &[DVec2] {
        &self.points[..self.count]
    }

    /// The middle of the points and the distance to the farthest of them; nothing for so few that
    /// it is not worth a look.
    pub(super) fn extent(&self) -> Option<(DVec2, f64)> {
        let [first, _, .., last] = self.points() else { return None };
        Some((0.5 * (*first + *last), 0.5 * (last.y - first.y)))
    }
}
