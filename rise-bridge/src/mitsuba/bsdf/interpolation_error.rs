//! The interpolation error of a table, and the smallest size within a tolerance.

use super::{
    nodes::{BsdfGrid, linear},
    sampler::{BsdfSampler, LAST_THETA, OFF_AXIS},
    size::{BsdfChannels, BsdfSize},
};
use crate::export::{Bands, ExportError, InterpolationError, r4_sequence};

/// Candidate sizes of isotropic materials, from small to large.
const ISOTROPIC: [[usize; 3]; 5] =
    [[1, 16, 32], [1, 24, 64], [1, 32, 128], [1, 48, 256], [1, 64, 512]];
/// Candidate sizes with azimuths of the viewer.
const ANISOTROPIC: [[usize; 3]; 4] = [[19, 12, 32], [37, 20, 48], [73, 24, 96], [145, 32, 192]];

/// The error of f cos θ as readers interpolate it between the nodes.
///
/// # Errors
///
/// As for [`super::write()`].
pub fn interpolation_error(
    bands: &Bands,
    channels: BsdfChannels,
    size: BsdfSize,
) -> Result<InterpolationError, ExportError> {
    let sampler = BsdfSampler::new(bands, channels, size)?;
    Ok(InterpolationError::measure(|n| sample(&sampler, n)))
}

/// The smallest candidate at which 95 % of the light has a relative error below `tolerance`.
///
/// # Errors
///
/// If the largest candidate exceeds the tolerance, and as for [`super::write()`].
pub fn choose_size(
    bands: &Bands,
    channels: BsdfChannels,
    tolerance: f64,
) -> Result<(BsdfSize, InterpolationError), ExportError> {
    let candidates: &[_] = if bands.is_isotropic() { &ISOTROPIC } else { &ANISOTROPIC };
    let mut last = f64::INFINITY;
    for &[phi_i, theta_i, side] in candidates {
        let size = BsdfSize { phi_i, theta_i, side };
        let found = interpolation_error(bands, channels, size)?;
        if found.quantile_95 <= tolerance {
            return Ok((size, found));
        }
        last = found.quantile_95;
    }
    let [phi_i, theta_i, side] = candidates[candidates.len() - 1];
    let problem = format!(
        "the largest size, {phi_i}x{theta_i}x{side}, has an error of {:.2} %, more than {:.2} %",
        100.0 * last,
        100.0 * tolerance
    );
    Err(ExportError::refused("grid", problem))
}

/// Per channel (relative error, light) at the n-th pair of directions; empty where the light is
/// below the horizon or a model is not finite.
fn sample(sampler: &BsdfSampler<'_>, n: usize) -> Vec<(f64, f64)> {
    let [t, u, w, azimuth] = r4_sequence(n);
    let phi = sampler.phis[0] + azimuth * (sampler.phis[sampler.phis.len() - 1] - sampler.phis[0]);
    let theta = LAST_THETA.to_radians() * t;
    let here = sampler.at(theta, phi, u.max(OFF_AXIS), w);
    let grid = BsdfGrid { theta_i: &sampler.thetas, phi_i: &sampler.phis, side: sampler.size.side };
    let (Some((u, nodes)), Ok(exact)) =
        (grid.around(here.to_light, here.to_viewer), sampler.spectrum(&here))
    else {
        return Vec::new();
    };
    let ndf = |u: f64| f64::from(linear(&sampler.ndf, u));
    let exact: Vec<f64> = sampler.colours(&exact).collect();
    let mut read = vec![0.0; exact.len()];
    for (node, weight) in nodes {
        let node = sampler.node(node);
        let Ok(spectrum) = sampler.spectrum(&node) else { return Vec::new() };
        for (sum, value) in read.iter_mut().zip(sampler.colours(&spectrum)) {
            *sum += weight * value * ndf(u) / ndf(node.u);
        }
    }
    let measure = here.solid_angle() * theta.sin() * theta.cos();
    let compared = |(exact, read): (f64, f64)| {
        (exact > 0.0).then(|| ((read - exact).abs() / exact, measure * exact))
    };
    exact.into_iter().zip(read).filter_map(compared).collect()
}
