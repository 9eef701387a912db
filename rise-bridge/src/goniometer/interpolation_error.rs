//! The interpolation error of a table, and the coarsest grid within a tolerance.

use scattering::{Basis, Geometry, Model};

use super::layout::GoniometerAxes;
use crate::export::{Bands, ExportError, InterpolationError, r3_sequence};

/// Candidate steps of θ_i, θ_s and φ_s in degrees, from coarse to fine.
const CANDIDATES: [[f64; 3]; 6] = [
    [16.0, 17.0, 20.0],
    [10.0, 5.0, 10.0],
    [5.0, 5.0, 5.0],
    [5.0, 2.5, 5.0],
    [2.5, 2.5, 2.5],
    [2.5, 1.25, 1.25],
];
/// Largest θ_i, θ_s and φ_s of a chosen grid, degrees.
const ENDS: [f64; 3] = [80.0, 85.0, 180.0];

/// The error of linear interpolation between the nodes of `axes`.
pub fn interpolation_error(bands: &Bands, axes: &GoniometerAxes) -> InterpolationError {
    InterpolationError::measure(|n| sample(bands, axes, n))
}

/// The coarsest candidate grid on which 95 % of the light has an error below `tolerance`.
///
/// # Errors
///
/// If the finest candidate exceeds the tolerance.
pub fn choose_axes(
    bands: &Bands,
    tolerance: f64,
) -> Result<(GoniometerAxes, InterpolationError), ExportError> {
    let mut last = f64::INFINITY;
    for steps in CANDIDATES {
        let nodes = |k: usize| {
            let count = (ENDS[k] / steps[k]).round() as usize;
            (0..=count).map(|i| steps[k] * i as f64).collect()
        };
        let axes = GoniometerAxes { thetai: nodes(0), thetas: nodes(1), phis: nodes(2) };
        let found = interpolation_error(bands, &axes);
        if found.quantile_95 <= tolerance {
            return Ok((axes, found));
        }
        last = found.quantile_95;
    }
    let [i, s, phi] = CANDIDATES[CANDIDATES.len() - 1];
    let problem = format!(
        "the finest grid, steps of {i}, {s} and {phi} degrees, has an error of {:.2} %, more than \
         {:.2} %; give the nodes around the highlight",
        100.0 * last,
        100.0 * tolerance
    );
    Err(ExportError::refused("grid", problem))
}

/// Per wavelength (relative error, light) at the n-th direction inside the table.
fn sample(bands: &Bands, axes: &GoniometerAxes, n: usize) -> Vec<(f64, f64)> {
    let parts = r3_sequence(n);
    let axes = [&axes.thetai, &axes.thetas, &axes.phis];
    let at: [f64; 3] = std::array::from_fn(|k| {
        let (first, last) = (axes[k][0], axes[k][axes[k].len() - 1]);
        first + parts[k] * (last - first)
    });
    let geometry = |[i, s, phi]: [f64; 3]| Geometry {
        theta_i: i.to_radians(),
        theta_s: s.to_radians(),
        phi_s: phi.to_radians(),
        rotation: 0.0,
    };
    let measure = [0, 1].map(|k: usize| at[k].to_radians().sin_cos()).map(|(sin, cos)| sin * cos);
    let corners = corners(axes, at);
    let compared = |model: &Model| {
        let value = |at| model.mueller(&geometry(at), Basis::Psps)[(0, 0)];
        let exact = value(at);
        let table: f64 = corners.iter().map(|(node, weight)| weight * value(*node)).sum();
        (exact > 0.0).then(|| ((table - exact).abs() / exact, measure[0] * measure[1] * exact))
    };
    bands.models().iter().filter_map(compared).collect()
}

/// The nodes around the direction `at`, and their weights.
fn corners(axes: [&Vec<f64>; 3], at: [f64; 3]) -> Vec<([f64; 3], f64)> {
    let sides: [[(f64, f64); 2]; 3] = std::array::from_fn(|k| {
        let nodes = axes[k];
        let upper = nodes.partition_point(|node| *node <= at[k]).min(nodes.len() - 1);
        let (low, high) = (nodes[upper.saturating_sub(1)], nodes[upper]);
        let part = if high > low { (at[k] - low) / (high - low) } else { 0.0 };
        [(low, 1.0 - part), (high, part)]
    });
    let corner = |c: usize| {
        let picked: [(f64, f64); 3] = std::array::from_fn(|k| sides[k][c >> k & 1]);
        (picked.map(|side| side.0), picked.iter().map(|side| side.1).product::<f64>())
    };
    (0..8).map(corner).filter(|(_, weight)| *weight > 0.0).collect()
}
