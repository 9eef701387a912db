//! How far a table is from its material between its nodes.

use rayon::prelude::*;

use super::even::quantile;

/// Directions in which table and material are compared.
const SAMPLES: usize = 4096;

/// Relative errors of f by the interpolation of readers, over all channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Half of the light has a smaller one.
    pub median: f64,
    /// 95 % of the light has.
    pub most: f64,
}

impl Spread {
    /// Of (relative error, light) of every channel at the n-th place that `sample` chooses.
    pub(crate) fn of(sample: impl Fn(usize) -> Vec<(f64, f64)> + Send + Sync) -> Self {
        let samples: Vec<(f64, f64)> = (0..SAMPLES).into_par_iter().flat_map_iter(sample).collect();
        Self { median: quantile(samples.clone(), 0.5), most: quantile(samples, 0.95) }
    }
}
