//! Logarithm of the gamma function.
//!
//! Stirling's series (Abramowitz & Stegun 6.1.40) above 15, where its seventh term is below
//! 10⁻¹⁷; smaller arguments are raised by Γ(x + 1) = x Γ(x).

use std::f64::consts::TAU;

/// ln Γ(x) for x > 0.
pub fn ln_gamma(x: f64) -> f64 {
    let (mut z, mut product) = (x, 1.0);
    while z < 15.0 {
        product *= z;
        z += 1.0;
    }
    stirling(z) - product.ln()
}

fn stirling(z: f64) -> f64 {
    /// B_2n/(2n(2n−1)).
    const TERMS: [f64; 7] = [
        1.0 / 12.0,
        -1.0 / 360.0,
        1.0 / 1260.0,
        -1.0 / 1680.0,
        1.0 / 1188.0,
        -691.0 / 360_360.0,
        1.0 / 156.0,
    ];
    let inverse = 1.0 / (z * z);
    let series = TERMS.iter().rev().fold(0.0, |sum, term| sum * inverse + term) / z;
    (z - 0.5) * z.ln() - z + 0.5 * TAU.ln() + series
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factorials_and_the_half_come_out() {
        assert!((ln_gamma(0.5) - 0.5 * std::f64::consts::PI.ln()).abs() < 1e-14);
        assert!(ln_gamma(1.0).abs() < 1e-14 && ln_gamma(2.0).abs() < 1e-14);
        assert!((ln_gamma(11.0) - 3_628_800f64.ln()).abs() < 1e-14 * 15.0);
    }
}
