//! Gauss–Legendre and Gauss–Radau quadrature.
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

/// Nodes and weights of Gauss–Radau on [a, b): the first node is a itself, `n` ≥ 1 in all.
///
/// The other nodes are the roots of P_{n−1} + P_n, found by Newton's method from the nodes of the
/// Chebyshev–Radau rule; their weights are (1 − x)/[n P_{n−1}(x)]², that of a is 2/n²
/// (Abramowitz & Stegun 25.4.31).
pub fn radau(n: usize, a: f64, b: f64) -> Vec<(f64, f64)> {
    const STEPS: usize = 8;
    let (half, size) = (0.5 * (b - a), n as f64);
    let mut rule = vec![(a, half * 2.0 / (size * size))];
    for j in 1..n {
        let mut x = -(2.0 * PI * j as f64 / (2.0 * size - 1.0)).cos();
        for _ in 0..STEPS {
            let ((p, dp), (q, dq)) = (polynomial(n - 1, x), polynomial(n, x));
            x -= (p + q) / (dp + dq);
        }
        let (p, _) = polynomial(n - 1, x);
        rule.push((a + half * (1.0 + x), half * (1.0 - x) / (size * p).powi(2)));
    }
    rule
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
    fn radau_is_exact_up_to_degree_2n_minus_2_and_starts_at_the_end() {
        for n in [1, 2, 3, 10] {
            let rule = radau(n, 0.0, 1.0);
            assert_eq!(rule[0].0, 0.0);
            for degree in 0..2 * n as i32 - 1 {
                let got: f64 = rule.iter().map(|(x, weight)| weight * x.powi(degree)).sum();
                assert!((got - 1.0 / f64::from(degree + 1)).abs() < 1e-14, "{n} {degree} {got}");
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
