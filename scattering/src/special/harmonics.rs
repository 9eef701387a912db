//! The angular functions of vector spherical harmonics.
//!
//! With P̃ = √((2l+1)(l−m)!/(l+m)!) P_l^m, without the sign (−1)^m, normalized so that
//! ∫P̃² dcos θ = 2,
//!
//! $$ \tau_l^m = \frac{d\tilde P_l^m}{d\theta}, \qquad \mu_l^m = \frac{m \tilde P_l^m}{\sin\theta} $$
//!
//! for real and complex angles. Both follow from Q = P̃/sin θ, which has no pole:
//! μ = mQ_l, τ = l cos θ Q_l − c Q_{l−1}, and τ_l^0 = −√(l(l+1)) sin θ Q_l^1.
//!
//! Digital Library of Mathematical Functions (NIST), 14.10.3 and 14.10.5.

use std::ops::{Add, Mul, Sub};

use num_complex::Complex64;

/// A real or complex number.
pub trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + From<f64>
{
    /// The number times a real one.
    fn times(self, factor: f64) -> Self;
    /// The number times a complex one.
    fn of(self, factor: Complex64) -> Complex64;
}

impl Scalar for f64 {
    fn times(self, factor: f64) -> Self {
        self * factor
    }

    fn of(self, factor: Complex64) -> Complex64 {
        factor * self
    }
}

impl Scalar for Complex64 {
    fn times(self, factor: f64) -> Self {
        self * factor
    }

    fn of(self, factor: Complex64) -> Complex64 {
        factor * self
    }
}

/// τ and μ of one direction, order by order.
#[derive(Clone, Debug)]
pub struct Harmonics {
    l_max: usize,
    m_max: usize,
    orders: Vec<OrderRecurrence>,
}

/// The recurrence over l of one order m.
#[derive(Clone, Debug)]
struct OrderRecurrence {
    /// Q_m^m over sin^{m−1} θ.
    first: f64,
    /// Q_l = a cos θ Q_{l−1} − b Q_{l−2}, and c of τ, for l from m.
    steps: Vec<RecurrenceStep>,
}

#[derive(Clone, Copy, Debug)]
struct RecurrenceStep {
    a: f64,
    b: f64,
    c: f64,
}

impl Harmonics {
    /// For 1 ≤ l ≤ `l_max` and 0 ≤ m ≤ `m_max`.
    pub fn new(l_max: usize, m_max: usize) -> Self {
        let mut first = 1.0;
        let order = |m: usize| {
            let m = m.max(1);
            if m <= l_max {
                first = (1..=m).map(|k| (1.0 + 0.5 / k as f64).sqrt()).product();
            }
            OrderRecurrence {
                first,
                steps: (m..=l_max).map(|l| RecurrenceStep::new(l as f64, m as f64)).collect(),
            }
        };
        Self { l_max, m_max, orders: (0..=m_max).map(order).collect() }
    }

    /// The largest l.
    pub fn l_max(&self) -> usize {
        self.l_max
    }

    /// The largest m.
    pub fn m_max(&self) -> usize {
        self.m_max
    }

    /// The smallest l of the order `m`.
    pub fn l_min(m: usize) -> usize {
        m.max(1)
    }

    /// Position of (m, l) in the order of [`Harmonics::visit`].
    pub fn place(&self, m: usize, l: usize) -> usize {
        let before: usize = (0..m).map(|m| self.l_max + 1 - Self::l_min(m)).sum();
        before + l - Self::l_min(m)
    }

    /// Calls `each` with (m, l, τ, μ), l within m, at the angle with this cosine and sine.
    pub fn visit<T: Scalar>(&self, cos: T, sin: T, mut each: impl FnMut(usize, usize, T, T)) {
        let mut power = T::from(1.0);
        for m in 0..=self.m_max {
            self.order(m, power, cos, sin, |l, tau, mu| each(m, l, tau, mu));
            if m > 0 {
                power = power * sin;
            }
        }
    }

    /// The order `m` alone: calls `each` with (l, τ, μ); `power` is sin^{m−1} θ, and 1 for m = 0.
    #[inline]
    pub fn order<T: Scalar>(
        &self,
        m: usize,
        power: T,
        cos: T,
        sin: T,
        mut each: impl FnMut(usize, T, T),
    ) {
        let order = &self.orders[m];
        let (mut before, mut q) = (T::from(0.0), power.times(order.first));
        for (l, step) in (Self::l_min(m)..).zip(&order.steps) {
            if l > Self::l_min(m) {
                (before, q) = (q, (cos * q).times(step.a) - before.times(step.b));
            }
            if m == 0 {
                let factor = -((l * (l + 1)) as f64).sqrt();
                each(l, (sin * q).times(factor), T::from(0.0));
            } else {
                let tau = (cos * q).times(l as f64) - before.times(step.c);
                each(l, tau, q.times(m as f64));
            }
        }
    }
}

impl RecurrenceStep {
    fn new(l: f64, m: f64) -> Self {
        let d = (l - m) * (l + m);
        let e = (l - 1.0 - m) * (l - 1.0 + m);
        let top = 2.0 * l + 1.0;
        if d == 0.0 {
            return Self { a: 0.0, b: 0.0, c: 0.0 };
        }
        Self {
            a: (top * (2.0 * l - 1.0) / d).sqrt(),
            b: (top * e.max(0.0) / (d * (2.0 * l - 3.0).max(1.0))).sqrt(),
            c: (top * d / (2.0 * l - 1.0)).sqrt(),
        }
    }
}

/// P̃_l^0 for l = 0 … `l_max`.
pub fn zonal(l_max: usize, cos: f64) -> Vec<f64> {
    let (mut before, mut p) = (0.0, 1.0);
    (0..=l_max)
        .map(|l| {
            let n = l as f64;
            let here = p;
            (before, p) = (p, ((2.0 * n + 1.0) * cos * p - n * before) / (n + 1.0));
            (2.0 * n + 1.0).sqrt() * here
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::special::gauss;

    fn all(theta: f64) -> Vec<(usize, usize, f64, f64)> {
        let mut out = Vec::new();
        let visit = |m, l, tau, mu| out.push((m, l, tau, mu));
        Harmonics::new(7, 5).visit(theta.cos(), theta.sin(), visit);
        out
    }

    #[test]
    fn tau_is_the_derivative_of_mu_sin_over_m_and_of_the_zonal_functions() {
        let (theta, step) = (0.7, 1e-5);
        let (below, here, above) = (all(theta - step), all(theta), all(theta + step));
        for at in 0..here.len() {
            let (m, l, tau, _) = here[at];
            let p = |list: &[(usize, usize, f64, f64)], theta: f64| match m {
                0 => zonal(l, theta.cos())[l],
                _ => list[at].3 * theta.sin() / m as f64,
            };
            let slope = (p(&above, theta + step) - p(&below, theta - step)) / (2.0 * step);
            // The second difference's own error: step² l³.
            assert!((slope - tau).abs() < 1e-7, "{m} {l}: {slope} {tau}");
        }
    }

    #[test]
    fn vector_harmonics_are_orthogonal_with_the_norm_2l_l_plus_1() {
        let rule = gauss::legendre(20, -1.0, 1.0);
        let tables: Vec<_> = rule.iter().map(|(x, w)| (all(x.acos()), *w)).collect();
        let first = &tables[0].0;
        for i in 0..first.len() {
            for j in 0..first.len() {
                if first[i].0 != first[j].0 {
                    continue;
                }
                let sum: f64 =
                    tables.iter().map(|(t, w)| w * (t[i].2 * t[j].2 + t[i].3 * t[j].3)).sum();
                let l = first[i].1 as f64;
                let expected = if i == j { 2.0 * l * (l + 1.0) } else { 0.0 };
                assert!((sum - expected).abs() < 1e-11, "{:?} {:?} {sum}", first[i], first[j]);
            }
        }
    }

    #[test]
    fn complex_angles_continue_real_ones() {
        let theta = Complex64::new(0.9, 0.0);
        let mut at = all(0.9).into_iter();
        Harmonics::new(7, 5).visit(theta.cos(), theta.sin(), |_, _, tau, mu| {
            let (.., real_tau, real_mu) = at.next().unwrap();
            assert!((tau - real_tau).norm() < 1e-12 && (mu - real_mu).norm() < 1e-12);
        });
    }
}
