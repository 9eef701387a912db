//! Gauss–Laguerre quadrature, for integrals with the weight e^{−x} from 0 to infinity.
//!
//! The nodes are the roots of L_n: bisection on the number of eigenvalues of its Jacobi matrix
//! (diagonal 2k+1, off-diagonal k) below a place, polished by Newton's method; the weights are
//! x/[(n+1) L_{n+1}(x)]² (Abramowitz & Stegun 25.4.45).

/// Nodes and weights of the rule with `n` ≤ 180 nodes, in rising order.
pub fn rule(n: usize) -> Vec<(f64, f64)> {
    (0..n)
        .map(|j| {
            let x = polish(n, bisect(n, j));
            let (beyond, _) = polynomial(n + 1, x);
            let root = x.sqrt() / ((n + 1) as f64 * beyond);
            (x, root * root)
        })
        .collect()
}

/// The root of L_n with `j` roots below it, to about ten digits.
fn bisect(n: usize, j: usize) -> f64 {
    // Every root lies below 4n (Szegő, Orthogonal Polynomials, 6.31).
    let (mut low, mut high) = (0.0, 4.0 * n as f64 + 2.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if roots_below(n, middle) > j {
            high = middle;
        } else {
            low = middle;
        }
    }
    0.5 * (low + high)
}

/// Sturm's count: the negative pivots of the Jacobi matrix less `x`.
fn roots_below(n: usize, x: f64) -> usize {
    let mut pivot = 1.0;
    (0..n)
        .filter(|&k| {
            let k = k as f64;
            let coupling = if k > 0.0 { k * k / pivot } else { 0.0 };
            pivot = 2.0 * k + 1.0 - x - coupling;
            if pivot == 0.0 {
                pivot = -f64::MIN_POSITIVE.sqrt();
            }
            pivot < 0.0
        })
        .count()
}

fn polish(n: usize, mut x: f64) -> f64 {
    for _ in 0..2 {
        let (p, before) = polynomial(n, x);
        let slope = n as f64 * (p - before) / x;
        x -= p / slope;
    }
    x
}

/// L_n and L_{n−1}.
fn polynomial(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut here) = (0.0, 1.0);
    for k in 0..n {
        let k = k as f64;
        (before, here) = (here, ((2.0 * k + 1.0 - x) * here - k * before) / (k + 1.0));
    }
    (here, before)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_integrate_to_factorials() {
        for n in [1, 2, 10, 40, 100] {
            let rule = rule(n);
            let mut factorial = 1.0;
            for degree in 0..(2 * n as i32).min(60) {
                factorial *= f64::from(degree.max(1));
                let got: f64 = rule.iter().map(|(x, w)| w * x.powi(degree)).sum();
                // Nodes are right to a few 1e-15; their powers lose that times the degree.
                assert!((got / factorial - 1.0).abs() < 1e-12, "{n} {degree} {got}");
            }
        }
    }
}
