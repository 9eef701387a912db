//! The parameters of models that use a T matrix.

use num_complex::Complex64;

use super::{
    blocks::{MOST, TMatrix},
    converged::{self, Orders},
};
use crate::{
    Mode, ParameterError, ParameterNode,
    shape::{self, Shape},
    spec::Parameter,
};

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
