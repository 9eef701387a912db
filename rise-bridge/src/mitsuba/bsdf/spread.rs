//! How far a table is from its material between its nodes, and the smallest size that is near.

use super::{
    AWAY, Channels, Job, LAST_THETA, Size,
    table::{self, Grid},
};
use crate::export::{Bands, ExportError, Spread, even_in_four};

/// Sizes that are tried for isotropic materials, from small to large.
const ISOTROPIC: [[usize; 3]; 5] =
    [[1, 16, 32], [1, 24, 64], [1, 32, 128], [1, 48, 256], [1, 64, 512]];
/// The same with azimuths of the viewer.
const ANISOTROPIC: [[usize; 3]; 4] = [[19, 12, 32], [37, 20, 48], [73, 24, 96], [145, 32, 192]];

/// The error of f cos θ as readers interpolate it between the nodes.
///
/// # Errors
///
/// As for [`super::write()`].
pub fn spread(bands: &Bands, channels: Channels, size: Size) -> Result<Spread, ExportError> {
    let job = Job::new(bands, channels, size)?;
    Ok(Spread::of(|n| sample(&job, n)))
}

/// The smallest size of a ladder at which 95 % of the light has a relative error below `tolerance`.
///
/// # Errors
///
/// If the largest is still too coarse, and as for [`super::write()`].
pub fn choose_size(
    bands: &Bands,
    channels: Channels,
    tolerance: f64,
) -> Result<(Size, Spread), ExportError> {
    let ladder: &[_] = if bands.is_isotropic() { &ISOTROPIC } else { &ANISOTROPIC };
    let mut last = f64::INFINITY;
    for &[phi_i, theta_i, side] in ladder {
        let size = Size { phi_i, theta_i, side };
        let found = spread(bands, channels, size)?;
        if found.most <= tolerance {
            return Ok((size, found));
        }
        last = found.most;
    }
    let [phi_i, theta_i, side] = ladder[ladder.len() - 1];
    let problem = format!(
        "the largest size, {phi_i}x{theta_i}x{side}, has an error of {:.2} %, more than {:.2} %",
        100.0 * last,
        100.0 * tolerance
    );
    Err(ExportError::refused("grid", problem))
}

/// Per channel (relative error, light) at the n-th pair of directions; nothing where the light is
/// below the horizon or a model has no number.
fn sample(job: &Job<'_>, n: usize) -> Vec<(f64, f64)> {
    let [t, u, w, azimuth] = even_in_four(n);
    let phi = job.phis[0] + azimuth * (job.phis[job.phis.len() - 1] - job.phis[0]);
    let theta = LAST_THETA.to_radians() * t;
    let here = job.at(theta, phi, u.max(AWAY), w);
    let grid = Grid { theta_i: &job.thetas, phi_i: &job.phis, side: job.size.side };
    let (Some((u, nodes)), Ok(exact)) =
        (grid.around(here.to_light, here.to_viewer), job.seen(&here))
    else {
        return Vec::new();
    };
    let ndf = |u: f64| f64::from(table::linear(&job.ndf, u));
    let exact: Vec<f64> = job.colours(&exact).collect();
    let mut read = vec![0.0; exact.len()];
    for (place, weight) in nodes {
        let node = job.node(place);
        let Ok(spectrum) = job.seen(&node) else { return Vec::new() };
        for (sum, value) in read.iter_mut().zip(job.colours(&spectrum)) {
            *sum += weight * value * ndf(u) / ndf(node.u);
        }
    }
    let measure = here.solid_angle() * theta.sin() * theta.cos();
    let compared = |(exact, read): (f64, f64)| {
        (exact > 0.0).then(|| ((read - exact).abs() / exact, measure * exact))
    };
    exact.into_iter().zip(read).filter_map(compared).collect()
}
