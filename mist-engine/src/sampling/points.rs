//! Points of the plane on their way to the sphere, part by part, so that the vectors of the
//! processor take several at once.

use glam::{DVec2, DVec3};
use scattering::lanes::{Batch, Vectors, WIDTH, with_widest};

use super::projection::Projection;
use crate::region::Frame;

/// Points in order.
pub(super) struct Points {
    count: usize,
    /// x and y in the plane.
    plane: [Vec<f64>; 2],
    /// x, y and z on the sphere.
    sphere: [Vec<f64>; 3],
    weights: Vec<f64>,
}

/// A point on the sphere.
pub(super) struct Lifted {
    pub(super) plane: DVec2,
    pub(super) v: DVec3,
    /// What makes up for the projection; later times cos θ.
    pub(super) weight: f64,
}

impl Points {
    /// No points yet, but room for `count`.
    pub(super) fn with_capacity(count: usize) -> Self {
        let room = || Vec::with_capacity(count.next_multiple_of(WIDTH));
        Self {
            count: 0,
            plane: [room(), room()],
            sphere: [room(), room(), room()],
            weights: room(),
        }
    }

    /// Adds points of the plane with one x.
    pub(super) fn push(&mut self, x: f64, ys: impl IntoIterator<Item = f64>) {
        let [all_x, all_y] = &mut self.plane;
        all_y.extend(ys);
        all_x.resize(all_y.len(), x);
        self.count = all_y.len();
    }

    /// x and y of the points in the plane.
    #[cfg(test)]
    pub(super) fn of_plane(&self) -> impl Iterator<Item = (f64, f64)> {
        self.plane[0].iter().copied().zip(self.plane[1].iter().copied())
    }

    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// The points on the sphere and their weights, in groups; the last one is filled up.
    pub(super) fn groups(&self) -> impl Iterator<Item = ([[f64; WIDTH]; 3], [f64; WIDTH])> {
        let [x, y, z] = self.sphere.each_ref().map(|part| part.as_chunks().0);
        x.iter()
            .zip(y)
            .zip(z)
            .zip(self.weights.as_chunks().0)
            .map(|(((x, y), z), w)| ([*x, *y, *z], *w))
    }

    /// Puts them on the sphere, about the axis of `frame`.
    pub(super) fn lift(&mut self, projection: Projection, frame: &Frame) {
        let whole = self.count().next_multiple_of(WIDTH);
        let parts = self.plane.iter_mut().chain(&mut self.sphere).chain([&mut self.weights]);
        parts.for_each(|part| part.resize(whole, 0.0));
        with_widest(Lifting { points: self, projection, frame });
    }

    /// Keeps the points that `keep` returns, as it returns them.
    pub(super) fn filter_map(&mut self, mut keep: impl FnMut(Lifted) -> Option<Lifted>) {
        let mut kept = 0;
        for k in 0..self.count() {
            let lifted = Lifted {
                plane: DVec2::new(self.plane[0][k], self.plane[1][k]),
                v: DVec3::new(self.sphere[0][k], self.sphere[1][k], self.sphere[2][k]),
                weight: self.weights[k],
            };
            if let Some(Lifted { v, weight, .. }) = keep(lifted) {
                (self.sphere[0][kept], self.sphere[1][kept], self.sphere[2][kept]) = v.into();
                self.weights[kept] = weight;
                kept += 1;
            }
        }
        self.count = kept;
        let whole = kept.next_multiple_of(WIDTH);
        let parts = self.plane.iter_mut().chain(&mut self.sphere).chain([&mut self.weights]);
        parts.for_each(|part| part.truncate(whole));
    }
}

/// The way of all points to the sphere.
struct Lifting<'a> {
    points: &'a mut Points,
    projection: Projection,
    frame: &'a Frame,
}

impl Batch for Lifting<'_> {
    #[inline(always)]
    fn run<V: Vectors>(self, vectors: V) {
        let Points { plane: [px, py], sphere: [x, y, z], weights, .. } = self.points;
        let from = px.as_chunks().0.iter().zip(py.as_chunks().0);
        let to = x.as_chunks_mut().0.iter_mut().zip(y.as_chunks_mut().0).zip(z.as_chunks_mut().0);
        for (((px, py), ((x, y), z)), weight) in from.zip(to).zip(weights.as_chunks_mut().0) {
            let (u, w) = self.projection.lift(vectors.load(px), vectors.load(py));
            let v = self.frame.turn(u);
            (*x, *y) = (vectors.store(v[0]), vectors.store(v[1]));
            (*z, *weight) = (vectors.store(v[2]), vectors.store(w));
        }
    }
}
