//! The T matrix that the parameters of a model describe.

use num_complex::Complex64;

use super::{
    blocks::TMatrix,
    converged::{self, Orders},
    parameters::{l_max, m_max, terms},
};
use crate::{Mode, ParameterError, ParameterNode, shape::Shape};

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
    let m_max = m_max(node)?;
    if node.mode == Mode::Sound {
        let orders = Orders::of_body(node, k * shape.reach())?;
        let compute = |level| converged::at_level(node, shape, index, k, m_max, level);
        return converged::converged(node, &orders, compute, |a, b| {
            converged::distance(a.blocks.iter().enumerate(), b.blocks.iter().enumerate())
        });
    }
    let l_max = l_max(node, terms(k * shape.reach()))?;
    TMatrix::of_revolution(shape, index, k, l_max, m_max.min(l_max)).ok_or_else(|| {
        ParameterError::new("lmax", "too many multipoles for this body: they overflow")
    })
}
