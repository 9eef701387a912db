//! Jones matrices in a basis of two field directions, usually (s, p).

use std::ops::{Add, Mul};

use num_complex::Complex64;

use super::Mueller;
use crate::lanes::{Complex, Real, SimdLevel, WIDTH};

/// A Jones matrix, output × input: `[[ss, ps], [sp, pp]]`, where `ps` turns p into s and `sp`
/// turns s into p.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Jones {
    /// s → s.
    pub ss: Complex64,
    /// p → s.
    pub ps: Complex64,
    /// s → p.
    pub sp: Complex64,
    /// p → p.
    pub pp: Complex64,
}

impl Jones {
    /// The matrix that scales s by `s` and p by `p`.
    pub fn diagonal(s: Complex64, p: Complex64) -> Self {
        Self { ss: s, pp: p, ..Self::default() }
    }

    /// The real matrix `[[ss, ps], [sp, pp]]`.
    pub fn real(ss: f64, ps: f64, sp: f64, pp: f64) -> Self {
        Self { ss: ss.into(), ps: ps.into(), sp: sp.into(), pp: pp.into() }
    }

    /// The same matrix with the signs of both off-diagonal elements turned.
    pub fn flipped(self) -> Self {
        Self { ps: -self.ps, sp: -self.sp, ..self }
    }

    /// Every element times the real number `factor`.
    pub fn scaled(self, factor: f64) -> Self {
        Self {
            ss: self.ss * factor,
            ps: self.ps * factor,
            sp: self.sp * factor,
            pp: self.pp * factor,
        }
    }

    /// The Mueller matrix of this non-depolarizing element.
    pub fn mueller(&self) -> Mueller {
        Mueller(elements([self.ss, self.ps, self.sp, self.pp].map(Complex::from)))
    }
}

/// The elements of the Mueller matrix of the Jones matrix with the elements ss, ps, sp, pp.
#[inline(always)]
pub(crate) fn elements<R: Real>([a, b, c, d]: [Complex<R>; 4]) -> [[R; 4]; 4] {
    let (a2, b2, c2, d2) = (a.norm_sqr(), b.norm_sqr(), c.norm_sqr(), d.norm_sqr());
    let (ab, cd) = (a.times_conjugate(b), d.times_conjugate(c));
    let (ac, bd) = (a.times_conjugate(c), d.times_conjugate(b));
    let (ad, bc) = (d.times_conjugate(a), b.times_conjugate(c));
    let half = |x: R| x * 0.5;
    // Im(a d*) = −Im(d a*), Im(c b*) = −Im(b c*), and so on: the rows of 1.4 written with six
    // products.
    [
        [half(a2 + b2 + c2 + d2), half(a2 - b2 + c2 - d2), ab.re + cd.re, ab.im - cd.im],
        [half(a2 + b2 - c2 - d2), half(a2 - b2 - c2 + d2), ab.re - cd.re, ab.im + cd.im],
        [ac.re + bd.re, ac.re - bd.re, ad.re + bc.re, -ad.im - bc.im],
        [-ac.im + bd.im, -ac.im - bd.im, ad.im - bc.im, ad.re - bc.re],
    ]
}

/// The Mueller matrices of the Jones matrices with the elements ss, ps, sp, pp, times `weight`.
#[inline(always)]
pub(crate) fn muellers<V: SimdLevel>(
    vectors: V,
    jones: [Complex<V::Vector>; 4],
    weight: V::Vector,
    out: &mut [Mueller; WIDTH],
) {
    for (i, row) in elements(jones).into_iter().enumerate() {
        for (j, element) in row.into_iter().enumerate() {
            for (m, x) in out.iter_mut().zip(vectors.store(element * weight)) {
                m.0[i][j] = x;
            }
        }
    }
}

impl Mul for Jones {
    type Output = Self;

    fn mul(self, r: Self) -> Self {
        Self {
            ss: self.ss * r.ss + self.ps * r.sp,
            ps: self.ss * r.ps + self.ps * r.pp,
            sp: self.sp * r.ss + self.pp * r.sp,
            pp: self.sp * r.ps + self.pp * r.pp,
        }
    }
}

impl Mul<Complex64> for Jones {
    type Output = Self;

    fn mul(self, z: Complex64) -> Self {
        Self { ss: self.ss * z, ps: self.ps * z, sp: self.sp * z, pp: self.pp * z }
    }
}

impl Add for Jones {
    type Output = Self;

    fn add(self, r: Self) -> Self {
        Self { ss: self.ss + r.ss, ps: self.ps + r.ps, sp: self.sp + r.sp, pp: self.pp + r.pp }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sixteen elements as they are printed in the specification, one by one.
    fn printed(j: &Jones) -> [[f64; 4]; 4] {
        let (a, b, c, d) = (j.ss, j.ps, j.sp, j.pp);
        let n = |z: Complex64| z.norm_sqr();
        [
            [
                0.5 * (n(a) + n(b) + n(c) + n(d)),
                0.5 * (n(a) - n(b) + n(c) - n(d)),
                (a * b.conj() + d * c.conj()).re,
                (a * b.conj() - d * c.conj()).im,
            ],
            [
                0.5 * (n(a) + n(b) - n(c) - n(d)),
                0.5 * (n(a) - n(b) - n(c) + n(d)),
                (a * b.conj() - d * c.conj()).re,
                (a * b.conj() + d * c.conj()).im,
            ],
            [
                (a * c.conj() + d * b.conj()).re,
                (a * c.conj() - d * b.conj()).re,
                (d * a.conj() + b * c.conj()).re,
                (a * d.conj() + c * b.conj()).im,
            ],
            [
                (c * a.conj() + d * b.conj()).im,
                (c * a.conj() - d * b.conj()).im,
                (d * a.conj() - b * c.conj()).im,
                (d * a.conj() - b * c.conj()).re,
            ],
        ]
    }

    fn sample(seed: f64) -> Jones {
        let z = |k: f64| Complex64::new((seed + k).sin(), (1.7 * seed - k).cos());
        Jones { ss: z(0.3), ps: z(1.1), sp: z(2.9), pp: z(4.4) }
    }

    #[test]
    fn mueller_has_the_sixteen_elements_of_the_definition() {
        for seed in [0.1, 0.9, 2.2] {
            let j = sample(seed);
            for (row, expected) in j.mueller().0.iter().zip(printed(&j)) {
                for (got, want) in row.iter().zip(expected) {
                    assert!((got - want).abs() < 1e-15, "{got} is not {want}");
                }
            }
        }
    }

    #[test]
    fn mueller_of_a_product_is_the_product_of_the_muellers() {
        let (j, k) = (sample(0.4), sample(1.3));
        let difference = (j * k).mueller() - j.mueller() * k.mueller();
        assert!(difference.largest() < 1e-14);
    }

    #[test]
    fn mirror_at_normal_incidence_is_diag_1_1_minus_1_minus_1() {
        // r_p = −r_s in the convention {s, p, k} right handed.
        let mirror = Jones::real(-1.0, 0.0, 0.0, 1.0).mueller();
        assert_eq!(mirror, Mueller::diagonal([1.0, 1.0, -1.0, -1.0]));
    }
}
