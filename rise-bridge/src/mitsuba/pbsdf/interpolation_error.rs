//! The interpolation error of a table, and the smallest grid within a tolerance.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use rayon::prelude::*;
use scattering::Mueller;

use super::{
    super::{
        axes::{HalfAngleAxes, LOWEST},
        frame::HalfAngles,
    },
    models::matrices,
    nodes::{AxisInterval, corners},
};
use crate::export::{Bands, ExportError, r3_sequence, weighted_quantile};

/// The number of directions in which table and material are compared.
const SAMPLES: usize = 4096;
/// Candidate grids, from small to large: nodes of φ_d, θ_d, θ_h.
const CANDIDATES: [[usize; 3]; 6] =
    [[19, 23, 46], [37, 46, 91], [37, 91, 181], [73, 91, 181], [73, 181, 361], [145, 181, 721]];

/// Quantiles of the relative error of linear interpolation, weighted by the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MuellerInterpolationError {
    /// The median of the error of M00.
    pub median: f64,
    /// The 95 % quantile of the error of M00.
    pub quantile_95: f64,
    /// The 95 % quantile of the largest error of an element over M00.
    pub polarization: f64,
}

/// The error of linear interpolation between the nodes of `axes`, all wavelengths together.
pub fn interpolation_error(bands: &Bands, axes: &HalfAngleAxes) -> MuellerInterpolationError {
    let samples: Vec<[f64; 3]> =
        (0..SAMPLES).into_par_iter().flat_map_iter(|n| sample(bands, axes, n)).collect();
    let of = |column: usize, part: f64| {
        weighted_quantile(samples.iter().map(|sample| (sample[column], sample[0])).collect(), part)
    };
    MuellerInterpolationError {
        median: of(1, 0.5),
        quantile_95: of(1, 0.95),
        polarization: of(2, 0.95),
    }
}

/// The smallest candidate grid on which 95 % of the light has a relative error below `tolerance`.
///
/// # Errors
///
/// If the largest candidate exceeds the tolerance.
pub fn choose_axes(
    bands: &Bands,
    tolerance: f64,
    uniform: bool,
) -> Result<(HalfAngleAxes, MuellerInterpolationError), ExportError> {
    let mut last = f64::INFINITY;
    for counts in CANDIDATES {
        let axes = HalfAngleAxes::new(counts, uniform)?;
        let found = interpolation_error(bands, &axes);
        if found.quantile_95 <= tolerance {
            return Ok((axes, found));
        }
        last = found.quantile_95;
    }
    let problem = format!(
        "the largest grid, {}x{}x{}, has an error of {:.2} %, more than {:.2} %",
        CANDIDATES[5][0],
        CANDIDATES[5][1],
        CANDIDATES[5][2],
        100.0 * last,
        100.0 * tolerance
    );
    Err(ExportError::refused("grid", problem))
}

/// Per wavelength (light, relative error of M00, largest error of an element over M00) at the
/// n-th pair of directions; empty if one of them is below the horizon.
fn sample(bands: &Bands, axes: &HalfAngleAxes, n: usize) -> Vec<[f64; 3]> {
    let [x, y, z] = r3_sequence(n);
    let at = HalfAngles { phi_d: TAU * x - PI, theta_d: FRAC_PI_2 * y, theta_h: FRAC_PI_2 * z * z };
    let (l, v) = at.directions();
    if l.z < LOWEST || v.z < LOWEST {
        return Vec::new();
    }
    // dω_l dω_v = 4 cos θ_d sin θ_d sin θ_h dθ_d dφ_d dθ_h dφ_h, and dθ_h = π z dz.
    let measure = l.z * v.z * at.theta_d.cos() * at.theta_d.sin() * at.theta_h.sin() * z;
    let intervals = [
        AxisInterval::of(at.phi_d, &axes.phi_d),
        AxisInterval::of(at.theta_d, &axes.theta_d),
        AxisInterval::of(at.theta_h, &axes.theta_h),
    ];
    let mut table = vec![Mueller::ZERO; bands.nm().len()];
    for (node, weight) in corners(intervals) {
        for (sum, m) in table.iter_mut().zip(matrices(bands, &axes.node(node))) {
            *sum += m * weight;
        }
    }
    let compared = |(exact, table): (Mueller, Mueller)| {
        let light = exact[(0, 0)];
        let difference = table - exact;
        (light > 0.0).then(|| {
            [measure * light, difference[(0, 0)].abs() / light, difference.largest() / light]
        })
    };
    matrices(bands, &at).zip(table).filter_map(compared).collect()
}
