//! Sums whose last bit does not depend on the number of threads.

use std::ops::AddAssign;

use rayon::prelude::*;

/// Chunk totals that are held at the same time: it bounds the memory of a sum.
const BLOCK: usize = 1024;

/// total(0) + total(1) + … + total(chunks − 1), added in this order on any number of threads,
/// or nothing once `stop` says so.
///
/// The totals are computed in parallel, a block at a time; a single one is computed in place. Each
/// thread has its own `S` to work in.
pub(crate) fn ordered<T: AddAssign + Default + Send, S: Default>(
    chunks: usize,
    stop: &(dyn Fn() -> bool + Sync),
    total: impl Fn(&mut S, usize) -> T + Sync,
) -> Option<T> {
    let mut sum = T::default();
    if chunks == 1 {
        sum += total(&mut S::default(), 0);
        return Some(sum);
    }
    for start in (0..chunks).step_by(BLOCK) {
        let block = start..chunks.min(start + BLOCK);
        let part = |scratch: &mut S, c| (!stop()).then(|| total(scratch, c));
        let parts: Option<Vec<T>> = block.into_par_iter().map_init(S::default, part).collect();
        for part in parts? {
            sum += part;
        }
    }
    Some(sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_two_and_seven_threads_give_the_same_bits() {
        let sum = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| ordered(5000, &|| false, |(), c| (c as f64 * 0.7).sin()).unwrap())
        };
        let one: f64 = sum(1);
        assert_eq!(one.to_bits(), f64::to_bits(sum(2)));
        assert_eq!(one.to_bits(), f64::to_bits(sum(7)));
    }

    #[test]
    fn a_stopped_sum_has_no_value() {
        assert_eq!(ordered(10, &|| true, |(), c| c as f64), None);
        assert_eq!(ordered(0, &|| true, |(), c| c as f64), Some(0.0));
    }
}
