//! Gauss–Legendre quadrature.
//!
//! The nodes are the roots of P_n, found by Newton's method from the asymptotic guess
//! cos[π(j − 1/4)/(n + 1/2)]; the weights are 2/[(1 − x²)P_n'(x)²] (Abramowitz & Stegun 25.4.29).

use std::f64::consts::PI;

/// Nodes and weights on (a, b), in rising order.
pub fn legendre(n: usize, a: f64, b: f64) -> Vec<(f64, f64)> {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    (1..=n)
        .rev()
        .map(|j| {
            let (x, weight) = node(n, j);
            (middle + half * x, half * weight)
        })
        .collect()
}

/// ∫ f over (a, b) with `n` nodes.
pub fn integrate(n: usize, a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
    legendre(n, a, b).into_iter().map(|(x, weight)| weight * f(x)).sum()
}

/// The j-th root of P_n from above, 1 ≤ j ≤ n, with its weight.
fn node(n: usize, j: usize) -> (f64, f64) {
    // Newton's method doubles the digits; a guess good to 1e-2 needs four steps.
    const STEPS: usize = 6;
    let mut x = (PI * (j as f64 - 0.25) / (n as f64 + 0.5)).cos();
    for _ in 0..STEPS {
        let (p, dp) = polynomial(n, x);
        x -= p / dp;
    }
    let (_, dp) = polynomial(n, x);
    (x, 2.0 / ((1.0 - x * x) * dp * dp))
}

/// P_n and its derivative at |x| < 1.
fn polynomial(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut p) = (0.0, 1.0);
    for k in 1..=n {
        let k = k as f64;
        (previous, p) = (p, ((2.0 * k - 1.0) * x * p - (k - 1.0) * previous) / k);
    }
    (p, n as f64 * (x * p - previous) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_up_to_degree_2n_minus_1_are_exact() {
        for n in [1, 2, 5, 20] {
            for degree in 0..2 * n as i32 {
                let got = integrate(n, 0.0, 1.0, |x| x.powi(degree));
                assert!((got - 1.0 / f64::from(degree + 1)).abs() < 1e-15, "{n} {degree}");
            }
        }
    }

    #[test]
    fn nodes_rise_and_weights_add_up_to_the_interval() {
        let rule = legendre(200, -1.0, 3.0);
        assert!(rule.windows(2).all(|w| w[0].0 < w[1].0));
        assert!((rule.iter().map(|r| r.1).sum::<f64>() - 4.0).abs() < 1e-13);
    }
}
