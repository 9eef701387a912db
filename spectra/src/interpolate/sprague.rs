//! Sprague's fifth-degree interpolation on equal steps.
//!
//! On the interval from sample p₀ to p₁ with X from 0 to 1,
//!
//! y = p₀ + X (a₁ + X (a₂ + X (a₃ + X (a₄ + X a₅)))),
//!
//! where the aᵢ come from the six neighbours p₋₂ … p₃. Beyond each end two samples are extrapolated
//! from the first (last) six.
//!
//! CIE 167:2005, *Recommended Practice for Tabulating Spectral Data for Use in Colour Computations*;
//! S. Westland, C. Ripamonti, V. Cheung, *Computational Colour Science Using MATLAB*, 2nd ed. (2012).

use super::interval::locate;

/// 24 times the coefficients a₁ … a₅ over p₋₂ … p₃.
const COEFFICIENTS: [[f64; 6]; 5] = [
    [2.0, -16.0, 0.0, 16.0, -2.0, 0.0],
    [-1.0, 16.0, -30.0, 16.0, -1.0, 0.0],
    [-9.0, 39.0, -70.0, 66.0, -33.0, 7.0],
    [13.0, -64.0, 126.0, -124.0, 61.0, -12.0],
    [-5.0, 25.0, -50.0, 50.0, -25.0, 5.0],
];

/// 209 times the weights of the first six samples in the outer and the inner additional sample.
const OUTER: [f64; 6] = [884.0, -1960.0, 3033.0, -2648.0, 1080.0, -180.0];
const INNER: [f64; 6] = [508.0, -540.0, 488.0, -367.0, 144.0, -24.0];

/// Interpolates at least six samples `y` at equally spaced, ascending `x`; `at` lies within `x`.
pub(super) fn interpolate(x: &[f64], y: &[f64], at: &[f64], out: &mut [f64]) {
    let padded = pad(y);
    for (out, &at) in out.iter_mut().zip(at) {
        let (i, t) = locate(x, at);
        let p = &padded[i..i + 6];
        let a = COEFFICIENTS.map(|row| dot(&row, p) / 24.0);
        *out = p[2] + t * (a[0] + t * (a[1] + t * (a[2] + t * (a[3] + t * a[4]))));
    }
}

/// The samples with two extrapolated samples before and after them.
fn pad(y: &[f64]) -> Vec<f64> {
    let first = &y[..6];
    let last: Vec<f64> = y.iter().rev().take(6).copied().collect();
    let mut padded = Vec::with_capacity(y.len() + 4);
    padded.extend([dot(&OUTER, first) / 209.0, dot(&INNER, first) / 209.0]);
    padded.extend_from_slice(y);
    padded.extend([dot(&INNER, &last) / 209.0, dot(&OUTER, &last) / 209.0]);
    padded
}

fn dot(weights: &[f64; 6], values: &[f64]) -> f64 {
    weights.iter().zip(values).map(|(w, v)| w * v).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_reproduced_away_from_the_ends() {
        let x: Vec<f64> = (0..10).map(f64::from).collect();
        let square: Vec<f64> = x.iter().map(|x| x * x).collect();
        let at = [2.5, 3.25, 4.75, 6.5];
        let mut out = [0.0; 4];
        interpolate(&x, &square, &at, &mut out);
        for (at, out) in at.iter().zip(out) {
            assert!((out - at * at).abs() < 1e-13, "{at}: {out}");
        }
    }

    #[test]
    fn a_constant_stays_constant_to_the_ends() {
        let x: Vec<f64> = (0..6).map(f64::from).collect();
        let mut out = [0.0; 5];
        interpolate(&x, &[0.3; 6], &[0.0, 0.1, 2.5, 4.9, 5.0], &mut out);
        // The weights 884 … -180 add up to 209: rounding of six terms of size 10.
        assert!(out.iter().all(|out| (out - 0.3).abs() < 1e-14));
    }
}
