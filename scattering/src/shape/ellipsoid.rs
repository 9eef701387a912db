//! Ellipsoid of revolution with its centre moved along the axis.
//!
//! r(θ) is the positive root of ((r cos θ − o)/v)² + (r sin θ/h)² = 1, v and h the vertical and
//! horizontal half axes, o the height of the origin over the centre, −`offset`.

use std::f64::consts::PI;

use super::{SHAPE, Shape, Spheroid, points};
use crate::{
    ParameterError,
    scatterer::positive,
    spec::{Class, Laws, Parameter, Spec},
};

/// Name, parameters and constructor of an ellipsoid.
pub const SPEC: Spec<Shape> = Spec {
    class: Class {
        name: "Ellipsoid_Axisymmetric_Shape",
        parent: "Axisymmetric_Shape",
        summary: "Ellipsoid of revolution",
        equation: "((r cos - o)/v)^2 + (r sin/h)^2 = 1",
        source: "mishchenko-2002",
        params: &[
            &SHAPE,
            &AXES,
            &[Parameter::number("offset", 0.0, "um", "Centre above the origin of the multipoles")],
        ],
        laws: Laws::NONE,
    },
    build: |node| {
        let (vertical, horizontal) = (positive(node, "vertical")?, positive(node, "horizontal")?);
        let offset = node.number("offset");
        if offset.is_nan() || offset.abs() >= vertical {
            let problem = format!("{offset} um puts the origin outside of the ellipsoid");
            return Err(ParameterError::new("offset", problem));
        }
        sampled(points(node)?, vertical, horizontal, -offset).checked("vertical")
    },
};

/// The half axes.
pub(super) const AXES: [Parameter; 2] = [
    Parameter::number("vertical", 0.05, "um", "Half axis along the axis of revolution"),
    Parameter::number("horizontal", 0.05, "um", "Half axis across it"),
];

/// The ellipsoid at `points` nodes.
pub(crate) fn sampled(points: usize, vertical: f64, horizontal: f64, offset: f64) -> Shape {
    let outline = |_, theta| radius(theta, vertical, horizontal, offset);
    let spheroid = (offset == 0.0).then_some(Spheroid { vertical, horizontal });
    Shape::sample(points, &[0.0, PI], outline).known_as(spheroid)
}

/// r and dr/dθ.
pub(super) fn radius(theta: f64, vertical: f64, horizontal: f64, offset: f64) -> (f64, f64) {
    let (sin, cos) = theta.sin_cos();
    let (v, h) = ((vertical * vertical).recip(), (horizontal * horizontal).recip());
    // a r² − 2b r + c = 0.
    let (a, b, c) = (cos * cos * v + sin * sin * h, offset * cos * v, offset * offset * v - 1.0);
    let root = (b * b - a * c).sqrt();
    let r = (b + root) / a;
    let (a1, b1) = (2.0 * sin * cos * (h - v), -offset * sin * v);
    (r, (2.0 * b1 - a1 * r) * r / (2.0 * root))
}
