//! The blocks of a T matrix, and the parameters of models that use one.

use faer::linalg::solvers::Solve;
use num_complex::Complex64;

use super::{
    converged::{self, Orders},
    waves::Multipole,
};
use crate::{
    Mode, ParameterError, ParameterNode,
    shape::{self, Shape},
    spec::Parameter,
    special::{harmonics::Harmonics, matrix::ComplexMatrix},
};

/// The largest l that is computed; a sphere of 80 wavelengths around needs as many.
pub const MOST: usize = 100;

/// The blocks of a particle for the orders m = 0 … m_max.
#[derive(Clone, Debug)]
pub struct TMatrix {
    /// The largest l.
    pub l_max: usize,
    /// T_m.
    pub blocks: Vec<ComplexMatrix>,
}

impl TMatrix {
    /// The matrix of a sphere with the Mie coefficients (a_l, b_l), l from 1.
    pub fn sphere(coefficients: &[(Complex64, Complex64)]) -> Self {
        let l_max = coefficients.len();
        let block = |m: usize| {
            let size = l_max + 1 - Harmonics::l_min(m);
            ComplexMatrix::from_fn(2 * size, 2 * size, |row, column| {
                let (a, b) = coefficients[l_max - size + row % size];
                match (row == column, row < size) {
                    (false, _) => Complex64::ZERO,
                    (true, true) => -a,
                    (true, false) => -b,
                }
            })
        };
        Self { l_max, blocks: (0..=l_max).map(block).collect() }
    }

    /// The largest m.
    pub fn m_max(&self) -> usize {
        self.blocks.len() - 1
    }
}

/// The largest l that the parameter `lmax` requests if the size needs `needed`.
pub(crate) fn l_max(node: &ParameterNode, needed: usize) -> Result<usize, ParameterError> {
    let asked = i64::from(node.integer("lmax"));
    let l = if asked > 0 { asked } else { needed as i64 - asked };
    match usize::try_from(l) {
        Ok(l) if l <= MOST => Ok(l),
        _ => Err(ParameterError::new(
            "lmax",
            format!("{asked} asks for l up to {l}, more than {MOST}; the size needs {needed}"),
        )),
    }
}

/// The number of multipoles of a body of revolution of the size parameter `x`.
pub(crate) fn terms(x: f64) -> usize {
    (x + 4.05 * x.powf(0.3333) + 2.0) as usize
}

/// The T-matrix of the body `Shape` of `node`, of this index relative to the medium in which the
/// wave number is `k` 1/µm, with `lmax` and `mmax`: as they say in compat, and in sound runs with as
/// many more as it takes to converge.
///
/// # Errors
///
/// For numbers of multipoles that cannot be had, and in sound runs for those that do not converge.
pub(crate) fn read(
    node: &ParameterNode,
    shape: &Shape,
    index: Complex64,
    k: f64,
) -> Result<TMatrix, ParameterError> {
    let (needed, m_max) = (terms(k * shape.reach()), m_max(node)?);
    if node.mode == Mode::Sound {
        let orders = Orders::read(node, needed)?;
        let compute = |level| converged::at_level(node, shape, index, k, m_max, level);
        return converged::converged(node, orders, compute, |a, b| {
            converged::distance(a.blocks.iter().enumerate(), b.blocks.iter().enumerate())
        });
    }
    let l_max = l_max(node, needed)?;
    TMatrix::of_revolution(shape, index, k, l_max, m_max.min(l_max)).ok_or_else(|| {
        ParameterError::new("lmax", "too many multipoles for this body: they overflow")
    })
}

/// The largest m that the parameter `mmax` allows.
pub(crate) fn m_max(node: &ParameterNode) -> Result<usize, ParameterError> {
    match node.integer("mmax") {
        0 => Ok(usize::MAX),
        asked => usize::try_from(asked)
            .map_err(|_| ParameterError::new("mmax", format!("{asked} is negative"))),
    }
}

/// The parameters of a body of revolution.
pub(crate) const BODY: [Parameter; 2] = [
    Parameter::member(
        "Shape",
        &shape::FAMILY,
        "Ellipsoid_Axisymmetric_Shape",
        "Outline of the particle",
    ),
    Parameter::index("particle", (1.59, 0.0), "Index of the particle"),
];

/// The parameters of how many multipoles it gets.
pub(crate) const MULTIPOLES: [Parameter; 2] = [
    Parameter::integer("lmax", 0, "Largest l: 0 as the size needs, -n that and n more, n just n"),
    Parameter::integer("mmax", 0, "Largest m: 0 as lmax, n at most n"),
];

/// Calls `each` with l − max(1, m) and the outgoing multipole w = B v for the first `rows` values
/// of l, v the regular waves of one order.
pub(crate) fn apply(
    block: &ComplexMatrix,
    regular: &[Multipole],
    rows: usize,
    mut each: impl FnMut(usize, Multipole),
) {
    let size = block.nrows() / 2;
    for row in 0..rows {
        let mut w = Multipole::default();
        for (column, v) in regular.iter().enumerate() {
            for (kind, at) in [row, size + row].into_iter().enumerate() {
                let (e, h) = (block[(at, column)], block[(at, size + column)]);
                w.p[kind] += e * v.p[0] + h * v.p[1];
                w.s[kind] += e * v.s[0] + h * v.s[1];
            }
        }
        each(row, w);
    }
}

/// a⁻¹ b.
pub(crate) fn solve(a: &ComplexMatrix, b: &ComplexMatrix) -> ComplexMatrix {
    a.partial_piv_lu().solve(b)
}

/// True if every element is a finite number.
pub(crate) fn is_finite(matrix: &ComplexMatrix) -> bool {
    (0..matrix.ncols()).all(|column| matrix.col(column).iter().all(|z| z.is_finite()))
}
