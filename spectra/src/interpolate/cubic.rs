//! Cubic spline with not-a-knot ends.
//!
//! The slopes s at the samples make the second derivative continuous; at the second and the last
//! but one sample the third derivative is continuous too.
//!
//! C. de Boor, *A Practical Guide to Splines* (1978), chapter IV.

use super::interval::locate;

/// The values at `at` of the spline through the samples `y` at rising `x`.
///
/// Beyond the samples the first and the last cubic continue. There is no spline through fewer than
/// four samples, or through lists of unequal length.
pub fn cubic_spline(x: &[f64], y: &[f64], at: &[f64]) -> Option<Vec<f64>> {
    if x.len() < 4 || x.len() != y.len() {
        return None;
    }
    let mut out = vec![0.0; at.len()];
    interpolate(x, y, at, &mut out);
    Some(out)
}

/// Interpolates at least four samples `y` at ascending `x`; `at` lies within `x`.
pub(crate) fn interpolate(x: &[f64], y: &[f64], at: &[f64], out: &mut [f64]) {
    let slope = slopes(x, y);
    for (out, &at) in out.iter_mut().zip(at) {
        let (i, t) = locate(x, at);
        let h = x[i + 1] - x[i];
        let rise = y[i + 1] - y[i];
        let a = h * slope[i] - rise;
        let b = rise - h * slope[i + 1];
        *out = y[i] + t * rise + t * (1.0 - t) * (a * (1.0 - t) + b * t);
    }
}

/// The slopes at the samples, from a tridiagonal system.
fn slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let n = x.len();
    let h: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let secant: Vec<f64> = y.windows(2).zip(&h).map(|(pair, h)| (pair[1] - pair[0]) / h).collect();

    let mut system = Tridiagonal::with_capacity(n);
    let span = h[0] + h[1];
    system.push(
        [0.0, h[1], span],
        ((h[0] + 2.0 * span) * h[1] * secant[0] + h[0] * h[0] * secant[1]) / span,
    );
    for i in 1..n - 1 {
        system.push(
            [h[i], 2.0 * (h[i - 1] + h[i]), h[i - 1]],
            3.0 * (h[i] * secant[i - 1] + h[i - 1] * secant[i]),
        );
    }
    let (h1, h2) = (h[n - 2], h[n - 3]);
    let span = h1 + h2;
    system.push(
        [span, h2, 0.0],
        (h1 * h1 * secant[n - 3] + (2.0 * span + h1) * h2 * secant[n - 2]) / span,
    );
    system.solve()
}

/// A tridiagonal system, eliminated row by row as it comes.
///
/// No pivoting: after elimination every diagonal is a sum of steps, so positive.
struct Tridiagonal {
    above: Vec<f64>,
    right: Vec<f64>,
}

impl Tridiagonal {
    fn with_capacity(n: usize) -> Self {
        Self { above: Vec::with_capacity(n), right: Vec::with_capacity(n) }
    }

    fn push(&mut self, [below, diagonal, above]: [f64; 3], right: f64) {
        let (above_before, right_before) =
            (self.above.last().copied().unwrap_or(0.0), self.right.last().copied().unwrap_or(0.0));
        let pivot = diagonal - below * above_before;
        self.above.push(above / pivot);
        self.right.push((right - below * right_before) / pivot);
    }

    fn solve(self) -> Vec<f64> {
        let mut solution = self.right;
        for i in (0..solution.len() - 1).rev() {
            solution[i] -= self.above[i] * solution[i + 1];
        }
        solution
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_reproduced_on_uneven_samples() {
        let cubic = |x: f64| 0.7 - 1.1 * x + 0.4 * x * x - 0.05 * x * x * x;
        let at = [0.0, 0.35, 1.9, 3.2, 6.9, 7.0];
        for x in [vec![0.0, 1.0, 2.5, 7.0], vec![0.0, 0.3, 2.5, 3.0, 6.0, 7.0]] {
            let y: Vec<f64> = x.iter().copied().map(cubic).collect();
            let mut out = [0.0; 6];
            interpolate(&x, &y, &at, &mut out);
            for (at, out) in at.iter().zip(out) {
                // Rounding: values up to 5, a handful of operations.
                assert!((out - cubic(*at)).abs() < 1e-13, "{at}: {out}");
            }
        }
    }
}
