//! Exact energy balance of a discretized kernel: the smallest symmetric correction that restores it.
//!
//! ε is the flux of each node. Column j of the kernel A should carry the flux t_j; the error of the
//! quadrature is r = εᵀA − tᵀ. The symmetric correction of least norm that removes it is
//!
//! $$ A \to A - \frac{\varepsilon r^T + r\varepsilon^T}{\varepsilon\cdot\varepsilon}
//!    + \frac{(r\cdot\varepsilon)\,\varepsilon\varepsilon^T}{(\varepsilon\cdot\varepsilon)^2} \qquad (1) $$

use super::block::RealMatrix;

/// Corrects the symmetric matrix `a` by (1) for the fluxes `flux` and the row `target`, and returns
/// the largest |r| over the largest flux.
pub fn restore(a: &mut RealMatrix, flux: &[f64], target: &[f64]) -> f64 {
    let n = a.nrows();
    let column = |j: usize| (0..n).map(|i| flux[i] * a[(i, j)]).sum::<f64>() - target[j];
    let missed: Vec<f64> = (0..n).map(column).collect();
    let whole: f64 = flux.iter().map(|x| x * x).sum();
    let along: f64 = missed.iter().zip(flux).map(|(r, e)| r * e).sum::<f64>() / (whole * whole);
    for j in 0..n {
        for i in 0..n {
            a[(i, j)] +=
                along * flux[i] * flux[j] - (flux[i] * missed[j] + missed[i] * flux[j]) / whole;
        }
    }
    let largest = |v: &[f64]| v.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    largest(&missed) / largest(flux)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_balanced_matrix_stays_symmetric() {
        let n = 5;
        let mut a = RealMatrix::from_fn(n, n, |i, j| 1.0 / (1 + i + j) as f64);
        let flux = [0.3, 0.0, 0.7, 0.0, 1.1];
        let target = [0.1, -0.2, 0.3, 0.0, 0.5];
        restore(&mut a, &flux, &target);
        for j in 0..n {
            let sum: f64 = (0..n).map(|i| flux[i] * a[(i, j)]).sum();
            assert!((sum - target[j]).abs() < 1e-15);
            assert!((0..n).all(|i| (a[(i, j)] - a[(j, i)]).abs() < 1e-15));
        }
    }
}
