//! Symmetric scaling of a kernel of positive terms to given column sums.
//!
//! X → s_i X_ij s_j with Σ_i e_i s_i X_ij s_j = t_j keeps reciprocity and realizability. R. Sinkhorn
//! and P. Knopp, Pac. J. Math. 21, 343 (1967).

/// Most steps, and the relative error that ends them.
const STEPS: usize = 2000;
const CLOSE: f64 = 1e-14;

/// The factors s for the elements `x(i, j)` between `n` nodes.
pub fn factors(flux: &[f64], target: &[f64], x: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    let n = flux.len();
    let elements: Vec<f64> = (0..n * n).map(|k| x(k % n, k / n)).collect();
    let mut s = vec![1.0; n];
    for _ in 0..STEPS {
        let mut worst: f64 = 0.0;
        let sums: Vec<f64> = (0..n)
            .map(|j| {
                let column = &elements[j * n..(j + 1) * n];
                column.iter().zip(flux).zip(&s).map(|((x, e), s)| x * e * s).sum::<f64>() * s[j]
            })
            .collect();
        for ((s, sum), target) in s.iter_mut().zip(sums).zip(target) {
            if sum > 0.0 && *target > 0.0 {
                let ratio = target / sum;
                worst = worst.max((ratio - 1.0).abs());
                *s *= ratio.sqrt();
            }
        }
        if worst < CLOSE {
            break;
        }
    }
    s
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_return_what_is_asked_for() {
        let x = |i: usize, j: usize| 1.0 / (1.0 + i as f64 + j as f64);
        let (flux, target) = ([1.0, 0.5, 0.3], [0.9, 0.2, 0.4]);
        let s = factors(&flux, &target, x);
        for j in 0..3 {
            let sum: f64 = (0..3).map(|i| flux[i] * s[i] * x(i, j) * s[j]).sum();
            assert!((sum - target[j]).abs() < 1e-13, "{sum}");
        }
    }
}
