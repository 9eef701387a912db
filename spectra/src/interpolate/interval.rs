//! The interval of a grid that contains a wavelength.

/// The interval that contains `at`: its lower index, and the fraction of `at` in it, from 0 to 1.
///
/// `nm` ascends, has at least two elements, and `at` lies within them.
pub(super) fn locate(nm: &[f64], at: f64) -> (usize, f64) {
    let below = nm.partition_point(|&sample| sample <= at);
    let i = below.saturating_sub(1).min(nm.len() - 2);
    (i, (at - nm[i]) / (nm[i + 1] - nm[i]))
}
