//! The edges of a polygon sorted into slabs of x, so that a test looks at the few that can matter.
//!
//! In a slab the edges run in a few bands of y. Between two bands every point is inside or every
//! point is outside, and no edge is looked at. The edges decide in the bands, and below a vertex
//! that is the leftmost or the rightmost of its neighbours: NIST's rules count a vertex above a
//! point by one of its two edges, which is the wrong number where the edges turn back.

use glam::DVec2;

use super::Edge;

/// Closer to an edge than this the edge itself decides; far more than rounding, far less than a
/// band is high.
pub(super) const MARGIN: f64 = 1e-9;

/// An edge whose two ends lie on the same side of a point in x is never counted, so leaving it
/// out changes no decision.
#[derive(Clone, Debug, Default)]
pub(super) struct Slabs {
    low: f64,
    high: f64,
    per_x: f64,
    slabs: Vec<Slab>,
    edges: Vec<Edge>,
    bands: Vec<Band>,
}

/// The parts of the lists that belong to a slab.
#[derive(Clone, Copy, Debug)]
struct Slab {
    edges: [u32; 2],
    bands: [u32; 2],
    /// Whether points above all bands are inside.
    above: bool,
    /// Up to this y the edges decide; −∞ where none of them turns back.
    turn: f64,
}

/// Where edges run, from below to above.
#[derive(Clone, Copy, Debug)]
pub(super) struct Band {
    pub(super) from: f64,
    pub(super) to: f64,
    /// Whether points between this band and the one below are inside.
    below: bool,
}

impl Slabs {
    /// `count` slabs of the polygon with these edges; none if it is empty or not finite.
    pub(super) fn new(edges: &[Edge], count: usize) -> Self {
        let xs = || edges.iter().map(|e| e.a.x);
        let (low, high) =
            (xs().fold(f64::INFINITY, f64::min), xs().fold(f64::NEG_INFINITY, f64::max));
        if edges.iter().any(|e| !e.a.is_finite()) || edges.is_empty() {
            return Self::default();
        }
        let per_x = if high > low { count as f64 / (high - low) } else { 0.0 };
        let mut slabs = Self { low, high, per_x, ..Self::default() };
        let reach = |edge: &Edge| {
            let (from, to) = (edge.a.x.min(edge.b.x), edge.a.x.max(edge.b.x));
            slabs.index(from, count)..=slabs.index(to, count)
        };
        // Where the edges of each slab begin, and behind the last one where they end.
        let mut starts = vec![0; count + 1];
        edges.iter().flat_map(reach).for_each(|k| starts[k + 1] += 1);
        for k in 0..count {
            starts[k + 1] += starts[k];
        }
        let (mut sorted, mut next) = (vec![edges[0]; starts[count]], starts.clone());
        for edge in edges {
            for k in reach(edge) {
                sorted[next[k]] = *edge;
                next[k] += 1;
            }
        }
        slabs.edges = sorted;
        let turns: Vec<DVec2> = turns(edges).collect();
        for (k, ends) in starts.windows(2).enumerate() {
            slabs.push(k, [ends[0], ends[1]], &turns);
        }
        slabs
    }

    /// Adds slab `k`, which holds the edges in `place`.
    fn push(&mut self, k: usize, place: [usize; 2], turns: &[DVec2]) {
        let at = |k: usize| self.low + k as f64 / self.per_x;
        let (left, right) = (at(k) - MARGIN, at(k + 1) + MARGIN);
        let here = turns.iter().filter(|turn| (left..=right).contains(&turn.x));
        // A polygon without a width is a single slab in which the edges decide.
        let no_width = if self.per_x == 0.0 { f64::INFINITY } else { f64::NEG_INFINITY };
        let turn = here.map(|turn| turn.y + MARGIN).fold(no_width, f64::max);
        let edges = &self.edges[place[0]..place[1]];
        let first = self.bands.len();
        self.bands.extend(edges.iter().filter_map(|edge| edge.band(left, right)));
        let bands = &mut self.bands[first..];
        bands.sort_unstable_by(|one, other| one.from.total_cmp(&other.from));
        // Bands that touch become one. Between two bands any point tells about all.
        let inside = |y: f64| counted(edges, DVec2::new(0.5 * (left + right), y));
        let (mut count, mut end) = (0, None);
        for k in 0..bands.len() {
            let band = bands[k];
            match end {
                Some(end) if band.from <= end => {
                    let last = &mut bands[count - 1];
                    last.to = last.to.max(band.to);
                }
                _ => {
                    let y = end.map_or(band.from - 1.0, |end| 0.5 * (end + band.from));
                    bands[count] = Band { below: inside(y), ..band };
                    count += 1;
                }
            }
            end = Some(bands[count - 1].to);
        }
        let above = end.is_some_and(|end| inside(end + 1.0));
        self.bands.truncate(first + count);
        self.slabs.push(Slab {
            edges: place.map(|at| at as u32),
            bands: [first as u32, self.bands.len() as u32],
            above,
            turn,
        });
    }

    /// The slab of `x`; a monotone function of it.
    fn index(&self, x: f64, count: usize) -> usize {
        (((x - self.low) * self.per_x) as usize).min(count - 1)
    }

    /// Whether `p` is inside of the polygon.
    #[inline]
    pub(super) fn contain(&self, p: DVec2) -> bool {
        if self.slabs.is_empty() || !(self.low <= p.x && p.x <= self.high) {
            return false;
        }
        let slab = &self.slabs[self.index(p.x, self.slabs.len())];
        self.between_bands(slab, p.y).unwrap_or_else(|| {
            let [first, last] = slab.edges.map(|at| at as usize);
            counted(&self.edges[first..last], p)
        })
    }

    /// Whether the point of `slab` at `y` is inside, if no edge needs to be asked.
    #[inline]
    fn between_bands(&self, slab: &Slab, y: f64) -> Option<bool> {
        if !(y > slab.turn) {
            return None;
        }
        let [first, last] = slab.bands.map(|at| at as usize);
        for band in &self.bands[first..last] {
            if y < band.from {
                return Some(band.below);
            }
            if y <= band.to {
                return None;
            }
        }
        Some(slab.above)
    }
}

/// Whether a ray from `p` counts an odd number of `edges`.
fn counted(edges: &[Edge], p: DVec2) -> bool {
    edges.iter().filter(|edge| edge.counts(p)).count() % 2 == 1
}

/// The vertices whose neighbours lie on the same side of them, or above or below.
pub(super) fn turns(edges: &[Edge]) -> impl Iterator<Item = DVec2> + '_ {
    let next = edges.iter().cycle().skip(1);
    edges.iter().zip(next).filter_map(|(edge, next)| {
        let (before, behind) = (edge.b.x - edge.a.x, next.b.x - next.a.x);
        (!(before * behind > 0.0)).then_some(edge.b)
    })
}

impl Edge {
    /// Where it runs between the abscissas `left` and `right`, if it does.
    pub(super) fn band(&self, left: f64, right: f64) -> Option<Band> {
        let Self { a, b } = self;
        let (from, to) = (left.max(a.x.min(b.x)), right.min(a.x.max(b.x)));
        if from > to {
            return None;
        }
        let at = |x: f64| a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x)).clamp(0.0, 1.0);
        let (one, other) = if a.x == b.x { (a.y, b.y) } else { (at(from), at(to)) };
        let (from, to) = (one.min(other) - MARGIN, one.max(other) + MARGIN);
        Some(Band { from, to, below: false })
    }
}
