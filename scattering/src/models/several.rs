//! The matrices of a batch: several directions at once, and what is left one by one.

use crate::{
    Direction, Mueller,
    lanes::{Batch, Vectors, WIDTH, with_widest},
};

/// A model under one beam, whose formula works on several directions.
pub(crate) trait Several {
    /// Puts the matrices of several directions into `out`.
    fn several<V: Vectors>(
        &self,
        vectors: V,
        directions: &[Direction; WIDTH],
        out: &mut [Mueller; WIDTH],
    );

    /// The matrix of one direction.
    fn one(&self, direction: &Direction) -> Mueller;
}

/// Puts the matrices of all `directions` into `out`, which has their number.
pub(crate) fn matrices(of: &impl Several, directions: &[Direction], out: &mut [Mueller]) {
    let ((directions, rest), (out, left)) = (directions.as_chunks(), out.as_chunks_mut());
    with_widest(Groups { of, directions, out });
    for (m, direction) in left.iter_mut().zip(rest) {
        *m = of.one(direction);
    }
}

struct Groups<'a, S> {
    of: &'a S,
    directions: &'a [[Direction; WIDTH]],
    out: &'a mut [[Mueller; WIDTH]],
}

impl<S: Several> Batch for Groups<'_, S> {
    #[inline(always)]
    fn run<V: Vectors>(self, vectors: V) {
        for (directions, out) in self.directions.iter().zip(self.out) {
            self.of.several(vectors, directions, out);
        }
    }
}
