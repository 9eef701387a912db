//! Zernike functions of a direction.
//!
//! F. Zernike, Physica 1, 689 (1934); M. Born and E. Wolf, *Principles of Optics*, 7th ed.,
//! section 9.2.1.

use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

/// The distinct Zernike functions that an expansion uses.
#[derive(Clone, Debug, Default)]
pub(super) struct ZernikeFunctions {
    all: Vec<ZernikeFunction>,
}

#[derive(Clone, Debug)]
struct ZernikeFunction {
    n: u32,
    k: i32,
    /// Coefficients of ρ^|k|, ρ^(|k|+2), …, ρ^n; none where n − |k| is odd or negative.
    radial: Vec<f64>,
}

impl ZernikeFunctions {
    /// Number of terms.
    pub(super) fn len(&self) -> usize {
        self.all.len()
    }

    /// The place of the function of order (n, k), which is added if it is new.
    pub(super) fn place(&mut self, n: u32, k: i32) -> usize {
        let known = self.all.iter().position(|h| (h.n, h.k) == (n, k));
        known.unwrap_or_else(|| {
            self.all.push(ZernikeFunction { n, k, radial: radial(n, k.unsigned_abs()) });
            self.all.len() - 1
        })
    }

    /// Their values at the polar angle `theta` and the azimuth `phi`, radians.
    pub(super) fn evaluate(&self, theta: f64, phi: f64, out: &mut [f64]) {
        let rho = SQRT_2 * (0.5 * theta).sin();
        for (value, harmonic) in out.iter_mut().zip(&self.all) {
            *value = harmonic.at(rho, phi);
        }
    }
}

impl ZernikeFunction {
    fn at(&self, rho: f64, phi: f64) -> f64 {
        let square = rho * rho;
        let polynomial = self.radial.iter().rev().fold(0.0, |sum, c| sum * square + c);
        let angle = f64::from(self.k) * phi;
        let azimuthal = match self.k {
            0 => FRAC_1_SQRT_2,
            1.. => angle.cos(),
            _ => -angle.sin(),
        };
        polynomial * rho.powi(self.k.abs()) * azimuthal
    }
}

/// R_n^k = Σ_s (−1)^s (n−s)! / (s! ((n+k)/2−s)! ((n−k)/2−s)!) ρ^(n−2s), by rising powers.
fn radial(n: u32, k: u32) -> Vec<f64> {
    if k > n || !(n - k).is_multiple_of(2) {
        return Vec::new();
    }
    let (sum, difference) = ((n + k) / 2, (n - k) / 2);
    let term = |s: u32| {
        let sign = if s.is_multiple_of(2) { 1.0 } else { -1.0 };
        sign * factorial(n - s) / (factorial(s) * factorial(sum - s) * factorial(difference - s))
    };
    (0..=difference).rev().map(term).collect()
}

fn factorial(n: u32) -> f64 {
    (1..=n).map(f64::from).product()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radial_polynomials_are_those_of_the_tables() {
        // Born & Wolf, table 9.1.
        assert_eq!(radial(0, 0), [1.0]);
        assert_eq!(radial(4, 0), [1.0, -6.0, 6.0]);
        assert_eq!(radial(3, 1), [-2.0, 3.0]);
        assert_eq!(radial(6, 2), [6.0, -20.0, 15.0]);
        assert_eq!(radial(3, 3), [1.0]);
        assert!(radial(3, 2).is_empty() && radial(1, 3).is_empty());
    }

    #[test]
    fn the_edge_of_the_disk_is_the_horizon() {
        let mut harmonics = ZernikeFunctions::default();
        let place = harmonics.place(5, 1);
        let mut out = [0.0];
        harmonics.evaluate(std::f64::consts::FRAC_PI_2, 0.0, &mut out);
        // R_n^k(1) = 1.
        assert!((out[place] - 1.0).abs() < 1e-14);
    }
}
