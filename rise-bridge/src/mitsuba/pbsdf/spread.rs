//! How far a table is from its material between the nodes, and the smallest grid that is near.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use rayon::prelude::*;
use scattering::Mueller;

use super::{
    super::{
        axes::{Axes, LOWEST},
        frame::HalfAngles,
    },
    matrices,
    table::{Place, corners},
};
use crate::export::{Bands, ExportError, even, quantile};

/// Directions in which table and material are compared.
const SAMPLES: usize = 4096;
/// Grids that are tried, from small to large: nodes of φ_d, θ_d, θ_h.
const LADDER: [[usize; 3]; 6] =
    [[19, 23, 46], [37, 46, 91], [37, 91, 181], [73, 91, 181], [73, 181, 361], [145, 181, 721]];

/// Differences between table and material over directions, weighted by the light they carry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Half of the light has a relative error of M00 below this.
    pub median: f64,
    /// 95 % of the light has.
    pub most: f64,
    /// 95 % of the light has an error of every element over M00 below this.
    pub polarization: f64,
}

/// The error of linear interpolation between the nodes of `axes`, all wavelengths together.
pub fn spread(bands: &Bands, axes: &Axes) -> Spread {
    let samples: Vec<[f64; 3]> =
        (0..SAMPLES).into_par_iter().flat_map_iter(|n| sample(bands, axes, n)).collect();
    let of = |column: usize, part: f64| {
        quantile(samples.iter().map(|sample| (sample[column], sample[0])).collect(), part)
    };
    Spread { median: of(1, 0.5), most: of(1, 0.95), polarization: of(2, 0.95) }
}

/// The smallest grid of a ladder on which 95 % of the light has a relative error below `tolerance`.
///
/// # Errors
///
/// If the largest is still too coarse.
pub fn choose_axes(
    bands: &Bands,
    tolerance: f64,
    uniform: bool,
) -> Result<(Axes, Spread), ExportError> {
    let mut last = f64::INFINITY;
    for counts in LADDER {
        let axes = Axes::new(counts, uniform)?;
        let found = spread(bands, &axes);
        if found.most <= tolerance {
            return Ok((axes, found));
        }
        last = found.most;
    }
    let problem = format!(
        "the largest grid, {}x{}x{}, has an error of {:.2} %, more than {:.2} %",
        LADDER[5][0],
        LADDER[5][1],
        LADDER[5][2],
        100.0 * last,
        100.0 * tolerance
    );
    Err(ExportError::refused("grid", problem))
}

/// Per wavelength (light, relative error of M00, largest error of an element over M00) at the
/// n-th pair of directions; nothing if one of them is below the horizon.
fn sample(bands: &Bands, axes: &Axes, n: usize) -> Vec<[f64; 3]> {
    let [x, y, z] = even(n);
    let at = HalfAngles { phi_d: TAU * x - PI, theta_d: FRAC_PI_2 * y, theta_h: FRAC_PI_2 * z * z };
    let (l, v) = at.directions();
    if l.z < LOWEST || v.z < LOWEST {
        return Vec::new();
    }
    // dω_l dω_v = 4 cos θ_d sin θ_d sin θ_h dθ_d dφ_d dθ_h dφ_h, and dθ_h = π z dz.
    let measure = l.z * v.z * at.theta_d.cos() * at.theta_d.sin() * at.theta_h.sin() * z;
    let places = [
        Place::of(at.phi_d, &axes.phi_d),
        Place::of(at.theta_d, &axes.theta_d),
        Place::of(at.theta_h, &axes.theta_h),
    ];
    let mut table = vec![Mueller::ZERO; bands.nm().len()];
    for (node, weight) in corners(places) {
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
