//! Straight lines between samples.

use super::interval::locate;

/// Interpolates samples `y` at ascending `x`; `at` lies within `x`.
pub(crate) fn interpolate(x: &[f64], y: &[f64], at: &[f64], out: &mut [f64]) {
    for (out, &at) in out.iter_mut().zip(at) {
        let (i, t) = locate(x, at);
        // This form gives both samples exactly.
        *out = if t == 1.0 { y[i + 1] } else { y[i] + t * (y[i + 1] - y[i]) };
    }
}
