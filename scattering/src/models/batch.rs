//! Matrices of a batch of directions in lanes; the remaining directions one by one.

use crate::{
    Direction, Mueller,
    lanes::{LaneKernel, SimdLevel, WIDTH, dispatch},
};

/// A model under one beam with a closed form for a batch of directions.
pub(crate) trait BatchKernel {
    /// Writes the matrices of a batch of directions to `out`.
    fn batch<V: SimdLevel>(
        &self,
        vectors: V,
        directions: &[Direction; WIDTH],
        out: &mut [Mueller; WIDTH],
    );

    /// The matrix of one direction.
    fn one(&self, direction: &Direction) -> Mueller;
}

/// Puts the matrices of all `directions` into `out`, which has their number.
pub(crate) fn evaluate(of: &impl BatchKernel, directions: &[Direction], out: &mut [Mueller]) {
    let ((directions, rest), (out, left)) = (directions.as_chunks(), out.as_chunks_mut());
    dispatch(GroupKernel { of, directions, out });
    for (m, direction) in left.iter_mut().zip(rest) {
        *m = of.one(direction);
    }
}

struct GroupKernel<'a, S> {
    of: &'a S,
    directions: &'a [[Direction; WIDTH]],
    out: &'a mut [[Mueller; WIDTH]],
}

impl<S: BatchKernel> LaneKernel for GroupKernel<'_, S> {
    #[inline(always)]
    fn run<V: SimdLevel>(self, vectors: V) {
        for (directions, out) in self.directions.iter().zip(self.out) {
            self.of.batch(vectors, directions, out);
        }
    }
}
