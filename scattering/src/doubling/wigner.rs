//! Wigner's small d functions d^l_mn(θ) as functions of x = cos θ.
//!
//! They start at l₀ = max(|m|, |n|) with
//!
//! $$ d^{l_0} = \xi\, 2^{-l_0}\binom{2l_0}{|m-n|}^{1/2}(1-x)^{|m-n|/2}(1+x)^{|m+n|/2} $$
//!
//! (ξ = 1 for n ≥ m, otherwise (−1)^{m−n}) and rise in l by
//!
//! $$ l\sqrt{(l+1)^2-m^2}\sqrt{(l+1)^2-n^2}\,d^{l+1} = (2l+1)[l(l+1)x-mn]\,d^l
//!    - (l+1)\sqrt{l^2-m^2}\sqrt{l^2-n^2}\,d^{l-1} $$
//!
//! D. A. Varshalovich, A. N. Moskalev and V. K. Khersonskii, *Quantum Theory of Angular Momentum*
//! (World Scientific, 1988), 4.3 and 4.8; M. I. Mishchenko, L. D. Travis and A. A. Lacis,
//! *Scattering, Absorption, and Emission of Light by Small Particles* (Cambridge, 2002), appendix B.

/// d^l_mn at x = cos θ for l = 0 … `top`; 0 below max(|m|, |n|).
pub fn wigner_d(m: i32, n: i32, x: f64, top: usize) -> Vec<f64> {
    let mut d = vec![0.0; top + 1];
    let start = m.unsigned_abs().max(n.unsigned_abs()) as usize;
    if start > top {
        return d;
    }
    d[start] = lowest(m, n, x, start);
    let (mf, nf) = (f64::from(m), f64::from(n));
    let root = |l: f64, k: f64| (l * l - k * k).max(0.0).sqrt();
    for l in start..top {
        let (below, lf) = (if l > 0 { d[l - 1] } else { 0.0 }, l as f64);
        d[l + 1] = if l == 0 {
            x
        } else {
            let next = lf + 1.0;
            let rising = (2.0 * lf + 1.0) * (lf * next * x - mf * nf) * d[l];
            let falling = next * root(lf, mf) * root(lf, nf) * below;
            (rising - falling) / (lf * root(next, mf) * root(next, nf))
        };
    }
    d
}

/// d^{l₀}_mn.
fn lowest(m: i32, n: i32, x: f64, start: usize) -> f64 {
    let (difference, sum) = ((m - n).unsigned_abs(), (m + n).unsigned_abs());
    // √C(2l₀, |m−n|) 2^{−l₀}, the product kept near 1.
    let mut factor = 1.0;
    let mut halves = 2 * start;
    for k in 1..=difference {
        factor *= f64::from(sum + k) / f64::from(k);
        while factor > 1.0 && halves > 0 {
            factor *= 0.5;
            halves -= 1;
        }
    }
    let factor = (factor * 0.5f64.powi(halves as i32)).sqrt();
    let sign = if n < m && difference % 2 == 1 { -1.0 } else { 1.0 };
    let power = |base: f64, twice: u32| base.max(0.0).sqrt().powi(twice as i32);
    sign * factor * power(1.0 - x, difference) * power(1.0 + x, sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn low_orders_have_their_closed_forms() {
        for x in [-1.0f64, -0.3, 0.0, 0.77, 1.0] {
            let s = (1.0 - x * x).sqrt();
            let cases = [
                (0, 0, 1, x),
                (0, 0, 2, 1.5 * x * x - 0.5),
                (0, 2, 2, (0.375f64).sqrt() * s * s),
                (2, 2, 2, 0.25 * (1.0 + x).powi(2)),
                (2, -2, 2, 0.25 * (1.0 - x).powi(2)),
                (1, 0, 1, -s / 2f64.sqrt()),
                (0, 1, 1, s / 2f64.sqrt()),
                (1, 2, 2, 0.5 * s * (1.0 + x)),
            ];
            for (m, n, l, expected) in cases {
                let got = wigner_d(m, n, x, 4)[l];
                assert!((got - expected).abs() < 1e-15, "{m} {n} {l} {x}: {got} {expected}");
            }
        }
    }

    #[test]
    fn functions_of_different_l_are_orthogonal() {
        let top = 40;
        for (m, n) in [(0, 0), (3, 2), (7, -2), (12, 0)] {
            let mut products = vec![vec![0.0; top + 1]; top + 1];
            for (x, w) in crate::special::gauss::legendre(64, -1.0, 1.0) {
                let d = wigner_d(m, n, x, top);
                for (row, a) in products.iter_mut().zip(&d) {
                    for (sum, b) in row.iter_mut().zip(&d) {
                        *sum += w * a * b;
                    }
                }
            }
            let start = m.max(n.abs()) as usize;
            for (l, row) in products.iter().enumerate().skip(start) {
                for (k, product) in row.iter().enumerate().skip(start) {
                    let expected = if k == l { 2.0 / (2 * l + 1) as f64 } else { 0.0 };
                    assert!((product - expected).abs() < 1e-13, "{m} {n} {l} {k}: {product}");
                }
            }
        }
    }
}
