//! The few operations on dense matrices that the recursion needs, without copies.

use faer::{
    Accum, Par,
    dyn_stack::{MemBuffer, MemStack, StackReq},
    linalg::{
        lu::partial_pivoting::{factor, solve},
        matmul::matmul,
    },
};
use num_complex::Complex64;

use crate::{interrupt, special::matrix::ComplexMatrix};

const ONE: Complex64 = Complex64::ONE;

/// a⁻¹ b by LU factorization with partial pivoting; both are used up.
pub(super) fn solve(mut a: ComplexMatrix, mut b: ComplexMatrix) -> ComplexMatrix {
    interrupt::check();
    let (n, columns) = (a.nrows(), b.ncols());
    let (mut forward, mut backward) = (vec![0_usize; n], vec![0_usize; n]);
    let mut memory = MemBuffer::new(StackReq::any_of(&[
        factor::lu_in_place_scratch::<usize, Complex64>(n, n, Par::Seq, Default::default()),
        solve::solve_in_place_scratch::<usize, Complex64>(n, columns, Par::Seq),
    ]));
    let (_, rows) = factor::lu_in_place(
        a.as_mut(),
        &mut forward,
        &mut backward,
        Par::Seq,
        MemStack::new(&mut memory),
        Default::default(),
    );
    interrupt::check();
    solve::solve_in_place(
        a.as_ref(),
        a.as_ref(),
        rows,
        b.as_mut(),
        Par::Seq,
        MemStack::new(&mut memory),
    );
    b
}

/// `onto` + `factor` · a · b.
pub(super) fn add_product(
    mut onto: ComplexMatrix,
    factor: Complex64,
    a: &ComplexMatrix,
    b: &ComplexMatrix,
) -> ComplexMatrix {
    interrupt::check();
    matmul(onto.as_mut(), Accum::Add, a, b, factor, Par::Seq);
    onto
}

/// The identity.
pub(super) fn identity(n: usize) -> ComplexMatrix {
    ComplexMatrix::identity(n, n)
}

/// (1 − f m)⁻¹(1 + f m) = 2(1 − f m)⁻¹ − 1.
pub(super) fn cayley(f: Complex64, mut m: ComplexMatrix) -> ComplexMatrix {
    change(&mut m, |z, diagonal| if diagonal { ONE - f * z } else { -f * z });
    let one = identity(m.nrows());
    let mut inverse = solve(m, one);
    change(&mut inverse, |z, diagonal| if diagonal { 2.0 * z - ONE } else { 2.0 * z });
    inverse
}

/// Replaces every element; the argument is true on the diagonal.
fn change(m: &mut ComplexMatrix, of: impl Fn(Complex64, bool) -> Complex64) {
    for j in 0..m.ncols() {
        for (i, z) in m.col_as_slice_mut(j).iter_mut().enumerate() {
            *z = of(*z, i == j);
        }
    }
}

/// Half the sum and half the difference.
pub(super) fn half_sum_and_difference(
    mut a: ComplexMatrix,
    mut b: ComplexMatrix,
) -> (ComplexMatrix, ComplexMatrix) {
    for j in 0..a.ncols() {
        for (x, y) in a.col_as_slice_mut(j).iter_mut().zip(b.col_as_slice_mut(j)) {
            (*x, *y) = (0.5 * (*x + *y), 0.5 * (*x - *y));
        }
    }
    (a, b)
}

/// `constant` on the diagonal plus Σ c_k m_k with real coefficients.
pub(super) fn combination(constant: f64, terms: [(f64, &ComplexMatrix); 4]) -> ComplexMatrix {
    let n = terms[0].1.nrows();
    let mut sum = ComplexMatrix::zeros(n, n);
    for j in 0..n {
        let column = sum.col_as_slice_mut(j);
        let [(a, p), (b, q), (c, r), (d, s)] = terms.map(|(c, m)| (c, m.col_as_slice(j)));
        for i in 0..n {
            column[i] = p[i] * a + q[i] * b + r[i] * c + s[i] * d;
        }
        column[j] += constant;
    }
    sum
}

/// Largest sum of absolute values in a column.
pub(super) fn column_norm(m: &ComplexMatrix) -> f64 {
    let sum = |j: usize| -> f64 { m.col_as_slice(j).iter().map(|z| z.norm_sqr().sqrt()).sum() };
    (0..m.ncols()).map(sum).fold(0.0, f64::max)
}
