//! The parameters of models that use a T matrix.

use super::blocks::MOST;
use crate::{ParameterError, ParameterNode, shape, spec::Parameter};

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
