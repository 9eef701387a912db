//! The interpolation error of a table between its nodes.

use rayon::prelude::*;

use super::quasirandom::weighted_quantile;

/// The number of directions in which table and material are compared.
const SAMPLES: usize = 4096;

/// Quantiles of the relative error of f that readers make by interpolation, weighted by the light,
/// over all channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InterpolationError {
    /// The median.
    pub median: f64,
    /// The 95 % quantile.
    pub quantile_95: f64,
}

impl InterpolationError {
    /// The quantiles of (relative error, light) of every channel; `sample` gives those at the n-th
    /// direction.
    pub(crate) fn measure(sample: impl Fn(usize) -> Vec<(f64, f64)> + Send + Sync) -> Self {
        let samples: Vec<(f64, f64)> = (0..SAMPLES).into_par_iter().flat_map_iter(sample).collect();
        Self {
            median: weighted_quantile(samples.clone(), 0.5),
            quantile_95: weighted_quantile(samples, 0.95),
        }
    }
}
