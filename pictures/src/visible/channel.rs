//! Masking and detection in each channel: from contrast to probability.
//!
//! Structure c of a picture raises the threshold to e(c) = (1 + (6 |c|)⁴)^¼, spread by a low-pass
//! because phases are uncertain; the smaller elevation of the two pictures counts (mutual masking). Daly's elevation (1 + (k₁ (k₂|c|)^s)^b)^(1/b) with W = 6, Q = 0.7, b = 4 and
//! slope s = 1, for which only the product k₁ k₂ = W matters.
//!
//! S. Daly (1993), see [`super`].

use rayon::prelude::*;

use super::{cortex, transform::Transform};

/// W of Daly's elevation.
const MASKING: f64 = 6.0;

/// The probability that an observer sees `test` differ from `reference`, both in units of threshold.
pub(super) fn detect(
    test: &[f64],
    reference: &[f64],
    transform: &Transform,
    compat: bool,
) -> Vec<f64> {
    let spectra = [test, reference].map(|picture| transform.spectrum(picture));
    let mut exponent = vec![0.0; test.len()];
    for channel in cortex::channels() {
        let filter = channel.filter(transform, compat);
        let spread = channel.spread(transform);
        let [t, r] = [0, 1].map(|which: usize| transform.picture(&spectra[which], &filter));
        let [raised_t, raised_r] = [&t, &r].map(|structure| {
            let raised: Vec<f64> = structure.par_iter().map(|c| elevation(*c)).collect();
            transform.picture(&transform.spectrum(&raised), &spread)
        });
        exponent.par_iter_mut().enumerate().for_each(|(i, exponent)| {
            let masked = raised_t[i].min(raised_r[i]).max(1.0);
            *exponent += power_3_5((t[i] - r[i]).abs() / masked);
        });
    }
    // 1 − Π exp(−x_c) = 1 − exp(−Σ x_c).
    exponent.par_iter().map(|x| 1.0 - (-x).exp()).collect()
}

/// The power 3.5 of the psychometric function; faster than a general power.
fn power_3_5(x: f64) -> f64 {
    x * x * x * x.sqrt()
}

/// The threshold elevation e(c).
fn elevation(structure: f64) -> f64 {
    (1.0 + (MASKING * structure).powi(4)).sqrt().sqrt()
}
