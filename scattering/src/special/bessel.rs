//! Bessel functions of the first kind, divided by the power of their argument.
//!
//! Digital Library of Mathematical Functions (NIST), chapter 10: 10.2.2 (power series),
//! 10.74(iv) (backward recurrence), 10.17.3 (Hankel's expansion).

use std::f64::consts::{FRAC_2_PI, FRAC_PI_4};

/// J_N(x)/|x|^N for N = 1 or 2; even in x, 1/(2^N N!) at 0. Good to about 10⁻¹⁵ of that value.
pub fn bessel_over_power<const N: usize>(x: f64) -> f64 {
    const { assert!(N == 1 || N == 2) };
    let x = x.abs();
    if x < 2.0 {
        power_series::<N>(x)
    } else if x < 25.0 {
        backward_recurrence::<N>(x) / x.powi(N as i32)
    } else {
        hankel_expansion::<N>(x) / x.powi(N as i32)
    }
}

fn power_series<const N: usize>(x: f64) -> f64 {
    let y = -0.25 * x * x;
    let mut term = if N == 1 { 0.5 } else { 0.125 };
    let mut sum = term;
    for k in 1..16 {
        term *= y / (k * (k + N)) as f64;
        sum += term;
    }
    sum
}

/// From an order where J is below 10⁻¹⁷ of its norm down to N; J_0 + 2 ΣJ_2k = 1 sets the scale.
fn backward_recurrence<const N: usize>(x: f64) -> f64 {
    let start = 2 * ((0.7 * x) as usize + 15);
    let (mut above, mut here) = (0.0, 1e-30);
    let (mut wanted, mut norm) = (0.0, 0.0);
    for order in (1..=start).rev() {
        if order == N {
            wanted = here;
        }
        if order.is_multiple_of(2) {
            norm += 2.0 * here;
        }
        (above, here) = (here, 2.0 * order as f64 / x * here - above);
    }
    wanted / (norm + here)
}

fn hankel_expansion<const N: usize>(x: f64) -> f64 {
    let mu = (4 * N * N) as f64;
    let (mut even, mut odd, mut term) = (1.0, 0.0, 1.0);
    // At x = 25 the twelfth term is below 10⁻¹⁶.
    for k in 1..=12 {
        term *= (mu - f64::from((2 * k - 1) * (2 * k - 1))) / (8.0 * f64::from(k) * x);
        match k % 4 {
            0 => even += term,
            1 => odd += term,
            2 => even -= term,
            _ => odd -= term,
        }
    }
    let phase = x - (2 * N + 1) as f64 * FRAC_PI_4;
    (FRAC_2_PI / x).sqrt() * (even * phase.cos() - odd * phase.sin())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// Bessel's integral by the midpoint rule, which converges exponentially; 10.9.2.
    fn integral(n: usize, x: f64) -> f64 {
        let m = 400;
        let values = (0..m).map(|k| {
            let t = PI * (k as f64 + 0.5) / m as f64;
            (n as f64 * t - x * t.sin()).cos()
        });
        values.sum::<f64>() / m as f64
    }

    #[test]
    fn the_three_expansions_agree_with_bessels_integral() {
        for j in 1..400 {
            let x = 0.25 * f64::from(j);
            // The integral itself is rounded to 10⁻¹⁵, its phase to x times that.
            let tolerance = 2e-15 * (1.0 + x);
            assert!((bessel_over_power::<1>(x) * x - integral(1, x)).abs() < tolerance, "{x}");
            assert!((bessel_over_power::<2>(x) * x * x - integral(2, x)).abs() < tolerance, "{x}");
        }
    }

    #[test]
    fn first_zeros_are_those_of_the_tables() {
        // Abramowitz & Stegun, table 9.5.
        assert!(bessel_over_power::<1>(3.83170_59702_07512).abs() < 1e-15);
        assert!(bessel_over_power::<2>(5.13562_23018_40683).abs() < 1e-15);
    }
}
