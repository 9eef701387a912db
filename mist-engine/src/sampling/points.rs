//! Points of the plane, part by part, so that the vectors of the processor take several at once.

use scattering::lanes::WIDTH;

/// Points in order.
#[derive(Debug, Default)]
pub(super) struct PlanePoints {
    count: usize,
    x: Vec<f64>,
    y: Vec<f64>,
}

impl PlanePoints {
    /// Takes all points away.
    pub(super) fn clear(&mut self) {
        self.count = 0;
        self.x.clear();
        self.y.clear();
    }

    /// Adds points with one x.
    pub(super) fn push(&mut self, x: f64, ys: impl IntoIterator<Item = f64>) {
        self.y.extend(ys);
        self.x.resize(self.y.len(), x);
        self.count = self.y.len();
    }

    /// Number of points.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// x and y in groups; zeros fill up the last one.
    pub(super) fn groups(
        &mut self,
    ) -> impl ExactSizeIterator<Item = (&[f64; WIDTH], &[f64; WIDTH])> {
        let whole = self.count.next_multiple_of(WIDTH);
        self.x.resize(whole, 0.0);
        self.y.resize(whole, 0.0);
        self.x.as_chunks().0.iter().zip(self.y.as_chunks().0)
    }

    /// x and y one by one.
    #[cfg(test)]
    pub(super) fn all(&self) -> impl Iterator<Item = (f64, f64)> {
        self.x.iter().copied().zip(self.y.iter().copied()).take(self.count)
    }
}
