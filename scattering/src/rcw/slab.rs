//! Reflection and transmission matrices of one homogeneous-in-z layer, by scaling and doubling.
//!
//! Waves are measured against the admittance 1: U = u + d, V = u − d with u upwards and d
//! downwards. About the middle of a slab of half thickness h the solutions of U'' = −PQ U are
//! even or odd, and with T = tan(√(PQ) h)/√(PQ)
//!
//! $$ r_{even} = \frac{1 + iQT}{1 - iQT}, \qquad r_{odd} = -\frac{1 + iTP}{1 - iTP}, \qquad
//! R = \tfrac12 (r_{even} + r_{odd}), \quad T = \tfrac12 (r_{even} - r_{odd}) $$
//!
//! T is a meromorphic function of PQ and needs no eigenvalues: it is the ninth convergent of the
//! continued fraction of the tangent, on a slab halved until the argument is below its first
//! pole. Doubling the slab again uses R and T alone; both are contractions for a passive medium.
//!
//! M. Abramowitz, I. A. Stegun, *Handbook of Mathematical Functions*, 4.3.94; H. C. van de Hulst,
//! *Multiple Light Scattering* (1980), for adding and doubling.

use super::{
    dense::{
        add_product, cayley, column_norm, combination, half_sum_and_difference, identity, solve,
    },
    layer::CoupledOperators,
};
use num_complex::Complex64;

use crate::{interrupt, special::matrix::ComplexMatrix};

const I: Complex64 = Complex64::I;
const ONE: Complex64 = Complex64::ONE;

/// Largest argument of the tangent; at 1.25 its ninth convergent is right to 3·10⁻¹⁵, and the
/// first pole is at 1.57.
const REACH: f64 = 1.25;

/// A slab with the same reflection and transmission from both sides.
pub struct SymmetricSlab {
    reflection: ComplexMatrix,
    transmission: ComplexMatrix,
}

impl SymmetricSlab {
    /// The slab of thickness `depth` in which the fields obey `pair`.
    pub fn new(pair: &CoupledOperators, depth: f64) -> Self {
        let powers = MatrixPowers::of(&pair.p * &pair.q);
        let argument = 0.5 * depth * powers.radius().sqrt();
        let doublings = (argument / REACH).log2().ceil().max(0.0);
        let doublings = if doublings.is_finite() { doublings as u32 } else { 0 };
        let half = 0.5 * depth * (-f64::from(doublings)).exp2();
        let tangent = powers.tangent(half);
        interrupt::check();
        let even = cayley(I * half, &pair.q * &tangent);
        let odd = cayley(I * half, &tangent * &pair.p);
        // r_odd is minus the Cayley transform.
        let (transmission, reflection) = half_sum_and_difference(even, odd);
        let mut slab = Self { reflection, transmission };
        for _ in 0..doublings {
            slab = slab.doubled();
        }
        slab
    }

    fn doubled(&self) -> Self {
        let (reflection, through) = self.above(&self.reflection);
        Self { reflection, transmission: &self.transmission * through }
    }

    /// Reflection by this slab on top of something that reflects by `below`, and the downward
    /// waves between the two from those above.
    pub fn above(&self, below: &ComplexMatrix) -> (ComplexMatrix, ComplexMatrix) {
        let (r, t) = (&self.reflection, &self.transmission);
        interrupt::check();
        let through = solve(add_product(identity(r.nrows()), -ONE, r, below), t.clone());
        (add_product(r.clone(), ONE, t, &(below * &through)), through)
    }
}

/// The first four powers of a matrix.
struct MatrixPowers([ComplexMatrix; 4]);

impl MatrixPowers {
    fn of(a: ComplexMatrix) -> Self {
        let a2 = &a * &a;
        interrupt::check();
        let a3 = &a * &a2;
        interrupt::check();
        let a4 = &a2 * &a2;
        Self([a, a2, a3, a4])
    }

    /// An upper bound of the spectral radius: the fourth root of the norm of the fourth power.
    fn radius(&self) -> f64 {
        let [a, .., a4] = &self.0;
        column_norm(a).min(column_norm(a4).sqrt().sqrt())
    }

    /// tan(√a h)/(√a h).
    fn tangent(&self, h: f64) -> ComplexMatrix {
        let (numerator, denominator) = convergent();
        solve(self.polynomial(&denominator, h * h), self.polynomial(&numerator, h * h))
    }

    /// Σ c_k (a x)^k.
    fn polynomial(&self, c: &[f64; 5], x: f64) -> ComplexMatrix {
        let [a, a2, a3, a4] = &self.0;
        let x2 = x * x;
        combination(
            c[0],
            [(c[1] * x, a), (c[2] * x2, a2), (c[3] * x * x2, a3), (c[4] * x2 * x2, a4)],
        )
    }
}

/// Numerator and denominator, in powers of x², of the ninth convergent of
/// tan(x)/x = 1/(1 − x²/(3 − x²/(5 − …))), scaled to 1 at x = 0.
fn convergent() -> ([f64; 5], [f64; 5]) {
    let step = |odd: f64, last: [f64; 5], before: [f64; 5]| -> [f64; 5] {
        std::array::from_fn(|k| odd * last[k] - if k > 0 { before[k - 1] } else { 0.0 })
    };
    let one = [1.0, 0.0, 0.0, 0.0, 0.0];
    let (mut n0, mut n1, mut d0, mut d1) = ([0.0; 5], one, one, one);
    for k in 2..=9 {
        let odd = f64::from(2 * k - 1);
        (n0, n1) = (n1, step(odd, n1, n0));
        (d0, d1) = (d1, step(odd, d1, d0));
    }
    (n1.map(|c| c / d1[0]), d1.map(|c| c / d1[0]))
}

#[cfg(test)]
mod tests {
    use num_complex::Complex64;

    use super::*;

    fn scalar(z: Complex64) -> ComplexMatrix {
        ComplexMatrix::from_fn(1, 1, |_, _| z)
    }

    /// Reflection and transmission of a film of index n at normal incidence, from Airy's sum.
    fn airy(n: Complex64, depth: f64) -> (Complex64, Complex64) {
        let r = (1.0 - n) / (1.0 + n);
        let round = (2.0 * I * n * depth).exp();
        let single = (I * n * depth).exp();
        let denominator = 1.0 - r * r * round;
        (r * (1.0 - round) / denominator, (1.0 - r * r) * single / denominator)
    }

    #[test]
    fn one_harmonic_is_airys_film_from_thin_to_very_thick() {
        for (n, depth) in [
            ((1.5, 0.0), 1e-6),
            ((1.5, 0.0), 0.3),
            ((3.9, 0.02), 2.0),
            ((0.2, 3.4), 40.0),
            ((1.5, 0.0), std::f64::consts::PI / 3.0),
            ((1.5, 1e-3), 3000.0),
        ] {
            let n = Complex64::new(n.0, n.1);
            let slab =
                SymmetricSlab::new(&CoupledOperators { p: scalar(ONE), q: scalar(n * n) }, depth);
            let (r, t) = airy(n, depth);
            // Rounding grows with the number of radians: 4·10⁻¹⁶ each, twofold margin.
            let tolerance = 1e-14 + 1e-15 * depth;
            assert!((slab.reflection[(0, 0)] - r).norm() < tolerance, "R of {n} at {depth}");
            assert!((slab.transmission[(0, 0)] - t).norm() < tolerance, "T of {n} at {depth}");
        }
    }
}
